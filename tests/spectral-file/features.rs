//! Files of formats that the crate was built without: `cargo test -p spectral-file --no-default-features features`.

#[cfg(not(feature = "xml"))]
#[test]
fn xml_names_its_feature() {
    fails_for(b"<?xml version=\"1.0\"?>\n<IESTM2714></IESTM2714>\n", "xml");
}

#[cfg(not(feature = "json"))]
#[test]
fn json_names_its_feature() {
    fails_for(b"{\"spectral_data\": {}}", "json");
}

#[cfg(not(feature = "encodings"))]
#[test]
fn other_encodings_name_their_feature() {
    fails_for(b"nm\tGr\xFC\xDFe\n400\t1\n410\t2\n", "encodings");
    fails_for(b"\xFF\xFE4\x000\x000\x00", "encodings");
}

#[cfg(not(all(feature = "xml", feature = "json", feature = "encodings")))]
fn fails_for(bytes: &[u8], feature: &str) {
    let error = spectral_file::read(bytes, &spectral_file::ReadOptions::default()).unwrap_err();
    assert!(error.to_string().ends_with(&format!("the feature {feature}")), "{error}");
}
