//! `report`.

use super::{refused, run};

#[test]
fn a_report_is_made_in_a_folder_with_any_cameras() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("mine");
    let out = out.to_str().unwrap();
    let arguments = ["report", "--out", out, "--camera", "Nikon D5100 (NPL)", "--picture-size", "16"];
    let output = run(&arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).ends_with("report.html\n"));
    assert!(output.stderr.is_empty(), "no bar where there is no terminal");
    for number in 1..=9 {
        for ending in ["pdf", "svg", "png", "csv"] {
            assert!(std::path::Path::new(out).join(format!("figure{number}.{ending}")).is_file());
        }
    }
    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    assert!(page.contains("Nikon D5100 (NPL)") && page.contains("Not judged") && !page.contains("Kodak DCS200"));
    let claims = std::fs::read_to_string(format!("{out}/claims.csv")).unwrap();
    assert!(claims.contains("not judged,,length in xy,Nikon D5100 (NPL)"), "{claims}");
    refused(&arguments, &["figure1.pdf", "--force"]);
    refused(
        &["report", "--out", out, "--session", "work.chromascope", "--camera", "Nikon D3300"],
        &["--session", "--camera"],
    );
}
