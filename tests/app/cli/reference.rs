//! Figures computed independently, with numpy from the same tables: resampling, sums, fits and matrices of its own.

#![allow(clippy::unreadable_literal, reason = "figures as another program printed them")]

use super::{PAPER, file, number, table};

/// Required agreement; both sums have 400 terms in double precision.
const TOLERANCE: f64 = 1e-11;

fn assert_close(row: &[String], expected: &[f64]) {
    assert_eq!(row.len(), expected.len(), "{row:?}");
    for (cell, expected) in row.iter().zip(expected) {
        assert!((number(cell) - expected).abs() < TOLERANCE, "{row:?}: {cell} is not {expected}");
    }
}

/// x, y, u′, v′ at 1000, 2856 and 20000 K.
#[test]
fn loci_by_the_paper() {
    let expected = [
        ("Stiles & Burch 1955 2°", [0.5655890899044567, 0.39056312841018037, 0.34510395420392553, 0.5361948901942214]),
        ("Stiles & Burch 1955 2°", [0.4023140367389297, 0.40792074546609397, 0.22696200634358585, 0.5177812114980418]),
        ("Stiles & Burch 1955 2°", [0.2533807472962752, 0.26050296728991834, 0.1803654651515979, 0.4172294603377063]),
        (
            "Canon EOS 10D (2007 figure)",
            [0.5740057118580644, 0.37546119741902484, 0.3611505404200342, 0.5315200284511595],
        ),
        (
            "Canon EOS 10D (2007 figure)",
            [0.3899928778362244, 0.3799378233448367, 0.23010913312532094, 0.5043966911063993],
        ),
        (
            "Canon EOS 10D (2007 figure)",
            [0.26480135380245556, 0.28595140725265966, 0.1794711563271649, 0.43606297776115327],
        ),
        ("Nikon D70 (2007 figure)", [0.5488779980733992, 0.36393787772970476, 0.35018940980259944, 0.522440651423869]),
        ("Nikon D70 (2007 figure)", [0.3901027227177273, 0.3829968374315605, 0.22894169812547566, 0.5057357146513916]),
        (
            "Nikon D70 (2007 figure)",
            [0.26344541826928386, 0.28175971392042876, 0.18000359425599902, 0.4331635884946357],
        ),
        ("Kodak DCS200", [0.39204115983752214, 0.30531244702071364, 0.2667097690161527, 0.46734143317221366]),
        ("Kodak DCS200", [0.338308260266, 0.3382443397492264, 0.21202853871657407, 0.4769740748187226]),
        ("Kodak DCS200", [0.2872200861752561, 0.3099793008225997, 0.18695233860507776, 0.4539743405631111]),
        ("CIE 1931 2°", [0.6527244178210028, 0.34448722255528275, 0.4479614716064471, 0.5319446425513552]),
        ("CIE 1931 2°", [0.44754183740874315, 0.40743815438129044, 0.25595121084170874, 0.5242853975659871]),
        ("CIE 1931 2°", [0.25649609797431394, 0.25775096052007973, 0.1838675336351399, 0.41572591551563476]),
    ];
    let rows = table(&["locus", "--preset", "paper", "--temperatures", "1000,2856,20000"]);
    assert_eq!(rows.len(), 1 + expected.len());
    for (row, (source, places)) in rows[1..].iter().zip(expected) {
        assert_eq!(row[0], source);
        assert_close(&row[2..6], &places);
        assert_eq!(row[11..], PAPER);
    }
}

#[test]
fn loci_by_an_observer() {
    let fit = ["--transform", "fitted", "--fit-to", "CIE 1964 10°", "--illuminant", "D65"];
    let sources = ["--camera", "Nikon D200", "--observer", "CIE 2006 2° cone fundamentals"];
    let rows = table(&[&["locus", "--temperatures", "4000"], &fit[..], &sources[..]].concat());
    assert_close(&rows[1][2..6], &[0.3812026786364257, 0.3707348374623452, 0.22804615639523612, 0.499013999093392]);
    assert_close(&rows[2][2..6], &[0.3834664325221403, 0.3753322270287063, 0.22767603794218297, 0.501404636775346]);
}

fn of_patches(rows: &[Vec<String>], source: &str) -> Vec<Vec<String>> {
    let wanted = ["dark skin", "orange yellow", "cyan"];
    let patch = |name: &str| rows.iter().find(|row| row[0] == source && row[1] == name).unwrap()[2..10].to_vec();
    wanted.map(patch).to_vec()
}

/// r, g, b, X, Y, Z, x, y under A, with the white of D55.
#[test]
fn patches_by_the_paper() {
    let sources = ["--camera", "Canon EOS 10D (2007 figure)", "--observer", "CIE 1964 10°"];
    let rows =
        table(&[&["patches", "--transform", "paper", "--illuminant", "A", "--white", "D55"], &sources[..]].concat());
    let camera = [
        [0.16403118723710713, 0.08423458473193814, 0.04819441639631084, 0.10646784127625816],
        [0.688298424731199, 0.36975858719553434, 0.09319649222198485, 0.4329019079863378],
        [0.0948644091145136, 0.23075124465988478, 0.3206212306338112, 0.17951085953860313],
    ];
    let rest = [
        [0.09859724227070477, 0.05901535719841665, 0.4031644334421271, 0.3733606396308995],
        [0.41751237339852637, 0.14594264904801643, 0.4344847662155145, 0.41903896148655534],
        [0.20835031641025634, 0.33408691117680595, 0.24864787751332693, 0.2885945958244363],
    ];
    for ((row, start), end) in of_patches(&rows, "Canon EOS 10D (2007 figure)").iter().zip(camera).zip(rest) {
        assert_close(row, &[start, end].concat());
    }
    let observer = [
        [0.14615027671644756, 0.1082589349558366, 0.019617306157999358, 0.5333435532942282, 0.3950673672497859],
        [0.633447916262435, 0.48240941998131837, 0.028113493612223445, 0.5537273326647539, 0.4216973085249495],
        [0.12468595451303428, 0.16780926697005372, 0.12980719808354596, 0.2952527590085484, 0.39736752430227446],
    ];
    for (row, expected) in of_patches(&rows, "CIE 1964 10°").iter().zip(observer) {
        assert!(row[..3].iter().all(String::is_empty), "CIE observers have no RGB");
        assert_close(&row[3..], &expected);
    }
}

#[test]
fn patches_by_an_observer() {
    let rows = table(&["patches", "--illuminant", "D65", "--transform", "fitted", "--camera", "Nikon D200"]);
    let signals = [
        [0.14097195727180317, 0.07824108757764948, 0.056604071251004466],
        [0.5803504708838866, 0.3135539895935983, 0.09127098283275925],
        [0.10947245388248321, 0.2721820094932074, 0.3875672249611397],
    ];
    let places = [
        [0.11220655398252885, 0.09862408059936868, 0.06228920794939655, 0.4108326694340131, 0.36110185069423634],
        [0.44658275325943875, 0.4190505765411409, 0.0825334800234628, 0.47099597732419474, 0.4419587062100464],
        [0.16615901194258145, 0.21075663927745117, 0.4291163215384662, 0.20614444284875233, 0.2614742918400304],
    ];
    for ((row, signals), places) in of_patches(&rows, "Nikon D200").iter().zip(signals).zip(places) {
        assert_close(row, &[&signals[..], &places[..]].concat());
    }
}

/// The paper's digits, through every kind of RGB source and under any light; unity to the last bit.
#[test]
fn a_perfect_white_through_any_camera() {
    let chart = file("white_for_all.csv", "wavelength_nm,white\n380,1\n780,1\n");
    let cameras =
        ["Canon EOS 10D (2007 figure)", "Nikon D70 (2007 figure)", "Kodak DCS200", "ARRI D21", "Sony ILCE-7M3"];
    let sources = cameras.iter().flat_map(|name| ["--camera", *name]).chain(["--observer", "Stiles & Burch 1955 2°"]);
    let sources: Vec<&str> = sources.collect();
    for light in ["E", "A", "D65", "blackbody:3000", "daylight:5503"] {
        let common = ["patches", "--preset", "paper", "--chart", chart.to_str().unwrap(), "--illuminant", light];
        let unity = table(&[&common[..], &sources].concat());
        assert_eq!(unity.len(), 7);
        assert!(unity[1..].iter().all(|row| row[2..5].iter().all(|cell| number(cell) == 1.0)), "{light}: {unity:?}");
        let d55 = table(&[&common[..], &sources, &["--white", "D55"]].concat());
        for row in &d55[1..] {
            assert_close(&row[2..5], &[1.1040009326280233, 0.9869845263196146, 0.8232987393051288]);
        }
    }
}
