//! Instruction sets of the geometry.

use super::*;

/// Numbers between -1 and 1 without any order.
fn number(seed: usize) -> f64 {
    let mixed = (seed as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    ((mixed ^ (mixed >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[test]
fn every_instruction_set_gives_the_same_bits() {
    let mut given = Given::NOTHING;
    for lane in 0..LANES {
        let numbers = |start: usize| [0, 1, 2].map(|k: usize| number(lane * 64 + start + k));
        (given.rays[0][lane], given.rays[1][lane]) = (number(lane * 64), number(lane * 64 + 1));
        given.weights.iter_mut().for_each(|row| row[lane] = 0.01 * lane as f32);
        put(&mut given.to_light, lane, DVec3::from(numbers(2)).normalize());
        for corner in 0..3 {
            for axis in 0..3 {
                given.points[corner][axis][lane] = numbers(5 + 3 * corner)[axis] as f32;
                given.normals[corner][axis][lane] = numbers(20 + 3 * corner)[axis] as f32;
            }
        }
    }
    // Some that need care: no normal, no light.
    given.normals.iter_mut().flatten().for_each(|row| row[7] = 0.0);
    put(&mut given.to_light, 9, DVec3::NAN);
    let view = DMat3::from_rotation_y(0.3);
    let (mut chosen, mut portable) = (Found::NOTHING, Found::NOTHING);
    find(&given, &view, &mut chosen);
    find_portable(&given, &view, &mut portable);
    assert_eq!((chosen.plain, chosen.behind), (portable.plain, portable.behind));
    assert!(!chosen.plain[7] && !chosen.plain[9]);
    let plain: Vec<usize> = (0..LANES).filter(|&lane| chosen.plain[lane]).collect();
    assert!(plain.len() > 10, "{} are plain", plain.len());
    for lane in plain {
        assert_eq!(chosen.angles(lane), portable.angles(lane));
        assert_eq!(chosen.normal(lane), portable.normal(lane));
    }
}
