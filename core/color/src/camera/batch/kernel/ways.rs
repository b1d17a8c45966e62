//! A register and what is done with it: for any processor, and in x86's instructions, which no optimizer has to find.
//!
//! Every way gives the same bits. Totals are the partial sums, pairwise in the order in which registers are shuffled, where
//! they are finite.

macro_rules! portable {
    ($type:ident, $lanes:literal) => {
        pub(crate) mod portable {
            use crate::math::array::{array, each};

            #[inline(always)]
            pub(crate) fn zero() -> [$type; $lanes] {
                [0.0; $lanes]
            }

            #[inline(always)]
            pub(crate) fn load(numbers: &[$type; $lanes]) -> [$type; $lanes] {
                *numbers
            }

            #[inline(always)]
            pub(crate) fn fuse(a: [$type; $lanes], b: [$type; $lanes], sum: [$type; $lanes]) -> [$type; $lanes] {
                array(|k| a[k].mul_add(b[k], sum[k]))
            }

            #[inline(always)]
            pub(crate) fn totals(sums: [[$type; $lanes]; 4]) -> [$type; 4] {
                let mut quarters = [[0.0; 4]; 4];
                for (quarter, sums) in quarters.iter_mut().zip(&sums) {
                    for k in 0..4 {
                        quarter[k] = if $lanes == 8 { sums[k] + sums[(k + 4) % $lanes] } else { sums[k] };
                    }
                }
                let [a, b, c, d] = quarters;
                let e = [a[0] + a[2], a[1] + a[3], b[0] + b[2], b[1] + b[3]];
                let f = [c[0] + c[2], c[1] + c[3], d[0] + d[2], d[1] + d[3]];
                let totals = [e[0] + e[1], e[2] + e[3], f[0] + f[1], f[2] + f[3]];
                each(totals, |total| if total.is_finite() { total } else { 0.0 })
            }
        }
    };
}

pub(super) mod f64 {
    portable!(f64, 4);

    #[cfg(target_arch = "x86_64")]
    pub(crate) mod avx2 {
        use std::arch::x86_64::{
            __m256d, _CMP_LT_OQ, _mm_cvtsd_f64, _mm_unpackhi_pd, _mm256_add_pd, _mm256_and_pd, _mm256_andnot_pd,
            _mm256_castpd256_pd128, _mm256_cmp_pd, _mm256_extractf128_pd, _mm256_fmadd_pd, _mm256_hadd_pd,
            _mm256_permute2f128_pd, _mm256_set1_pd, _mm256_setr_pd, _mm256_setzero_pd,
        };

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn zero() -> __m256d {
            _mm256_setzero_pd()
        }

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn load(&[a, b, c, d]: &[f64; 4]) -> __m256d {
            _mm256_setr_pd(a, b, c, d)
        }

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn fuse(a: __m256d, b: __m256d, sum: __m256d) -> __m256d {
            _mm256_fmadd_pd(a, b, sum)
        }

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn totals([a, b, c, d]: [__m256d; 4]) -> [f64; 4] {
            let (e, f) = (halves(a, b), halves(c, d));
            // The totals of a, c, b and d.
            let totals = _mm256_hadd_pd(e, f);
            let size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), totals);
            let is_finite = _mm256_cmp_pd::<_CMP_LT_OQ>(size, _mm256_set1_pd(f64::INFINITY));
            let totals = _mm256_and_pd(totals, is_finite);
            let (ac, bd) = (_mm256_castpd256_pd128(totals), _mm256_extractf128_pd::<1>(totals));
            let high = |two| _mm_cvtsd_f64(_mm_unpackhi_pd(two, two));
            [_mm_cvtsd_f64(ac), _mm_cvtsd_f64(bd), high(ac), high(bd)]
        }

        /// The sums of the halves of a, and those of b.
        #[inline]
        #[target_feature(enable = "avx2,fma")]
        fn halves(a: __m256d, b: __m256d) -> __m256d {
            _mm256_add_pd(_mm256_permute2f128_pd::<0x20>(a, b), _mm256_permute2f128_pd::<0x31>(a, b))
        }
    }
}

pub(super) mod f32 {
    portable!(f32, 8);

    #[cfg(target_arch = "x86_64")]
    pub(crate) mod avx2 {
        use std::arch::x86_64::{
            __m128, __m256, _mm_add_ps, _mm_and_ps, _mm_andnot_ps, _mm_cmplt_ps, _mm_extract_ps, _mm_hadd_ps,
            _mm_movehl_ps, _mm_movelh_ps, _mm_set1_ps, _mm256_castps256_ps128, _mm256_extractf128_ps, _mm256_fmadd_ps,
            _mm256_setr_ps, _mm256_setzero_ps,
        };

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn zero() -> __m256 {
            _mm256_setzero_ps()
        }

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn load(&[a, b, c, d, e, f, g, h]: &[f32; 8]) -> __m256 {
            _mm256_setr_ps(a, b, c, d, e, f, g, h)
        }

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn fuse(a: __m256, b: __m256, sum: __m256) -> __m256 {
            _mm256_fmadd_ps(a, b, sum)
        }

        #[inline]
        #[target_feature(enable = "avx2,fma")]
        pub(crate) fn totals([a, b, c, d]: [__m256; 4]) -> [f32; 4] {
            let (e, f) = (halves(quarter(a), quarter(b)), halves(quarter(c), quarter(d)));
            let totals = _mm_hadd_ps(e, f);
            let size = _mm_andnot_ps(_mm_set1_ps(-0.0), totals);
            let totals = _mm_and_ps(totals, _mm_cmplt_ps(size, _mm_set1_ps(f32::INFINITY)));
            let numbers = [
                _mm_extract_ps::<0>(totals),
                _mm_extract_ps::<1>(totals),
                _mm_extract_ps::<2>(totals),
                _mm_extract_ps::<3>(totals),
            ];
            crate::math::array::each(numbers, |bits| f32::from_bits(bits.cast_unsigned()))
        }

        /// The sums of the two halves.
        #[inline]
        #[target_feature(enable = "avx2,fma")]
        fn quarter(sums: __m256) -> __m128 {
            _mm_add_ps(_mm256_castps256_ps128(sums), _mm256_extractf128_ps::<1>(sums))
        }

        /// The sums of the halves of a, and those of b.
        #[inline]
        #[target_feature(enable = "avx2,fma")]
        fn halves(a: __m128, b: __m128) -> __m128 {
            _mm_add_ps(_mm_movelh_ps(a, b), _mm_movehl_ps(b, a))
        }
    }
}
