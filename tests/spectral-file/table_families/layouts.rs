//! Files as programs write them, with made-up numbers.

/// Argyll: keywords declared and repeated, bands by number, a scale.
pub(super) const ARGYLL_SP: &str = "SPECT\n\nDESCRIPTOR \"Lamp spectral power, 0% U.V.\"\n\nORIGINATOR \"Argyll CMS\"\n\n\
    CREATED \"Fri Jul 06 17:49:57 2001\"\nKEYWORD \"SPECTRAL_BANDS\"\nSPECTRAL_BANDS \"3\"\n\
    KEYWORD \"SPECTRAL_START_NM\"\nSPECTRAL_START_NM \"300.000000\"\nKEYWORD \"SPECTRAL_END_NM\"\n\
    SPECTRAL_END_NM \"310.000000\"\nKEYWORD \"SPECTRAL_NORM\"\nSPECTRAL_NORM \"100.000000\"\n\nKEYWORD \"SPEC_300\"\n\
    KEYWORD \"SPEC_305\"\nKEYWORD \"SPEC_310\"\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSPEC_300 SPEC_305 SPEC_310\n\
    END_DATA_FORMAT\n\nNUMBER_OF_SETS 1\nBEGIN_DATA\n0.0 25.0 57.82\nEND_DATA\n";

/// X-Rite: no type line, tabs inside quotes, a trailing comment.
pub(super) const XRITE: &str = "LGOROWLENGTH\t10\r\nCREATED\t\"11/14/2014\"  # Time: 16:45\r\n\
    MEASUREMENT_SOURCE\t\"Illumination=D65\tObserverAngle=10°\tFilter=No\"\r\nKEYWORD\t\"SampleID\"\r\n\
    BEGIN_DATA_FORMAT\r\nSampleID\tSAMPLE_NAME\tRGB_R\tnm380\tnm390\tnm400\r\nEND_DATA_FORMAT\r\nNUMBER_OF_SETS\t2\r\n\
    BEGIN_DATA\r\n1\tX1\t109.97\t0.0069\t0.0069\t0.0068\r\n2\t\"X 2\"\t241.52\t0.9009\t0.9024\t0.9046\r\nEND_DATA\r\n";

/// Ocean: blocks in a block, points in a form of its own.
pub(super) const JCAMP_LINK: &str = "##TITLE= EXPORTED SPECTRUM\n##DATA TYPE= LINK\n##BLOCKS= 2\n##OWNER= nobody\n\
    ##TITLE= EXPORTED SPECTRA: PROCESSED SPECTRUM\n##JCAMP-DX= 5 $$EXPORTED FILE\n##DATA TYPE= UV/VIS SPECTRUM\n\
    ##BLOCK_ID=1\n##XUNITS= NANOMETERS\n##YUNITS= Transmission (%)\n##XFACTOR= 1.0\n##YFACTOR= 1.0\n##FIRSTX= 400.5\n\
    ##LASTX= 401.5\n##NPOINTS= 3\n##XYPOINTS= (XY..XY)\n400.5, 25.0\n401.0, 30.0\n401.5, 35.0\n##END=\n\
    ##TITLE= EXPORTED SPECTRA: DARK SPECTRUM\n##BLOCK_ID=2\n##XUNITS= NANOMETERS\n##YUNITS= Transmission (%)\n\
    ##NPOINTS= 3\n##XYPOINTS= (XY..XY)\n400.5, 10.0\n401.0, 11.0\n401.5, 12.0\n##END=\n##END=   $$end of all blocks\n";

/// TM-27: one element for each sample, not sorted.
pub(super) const TM27: &str = "<?xml version=\"1.0\"?>\r\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\r\n\t<Header>\r\n\
    \t\t<Manufacturer>Nobody</Manufacturer>\r\n\t\t<Description>Made-up lamp</Description>\r\n\t</Header>\r\n\
    \t<SpectralDistribution>\r\n\t\t<SpectralQuantity>relative</SpectralQuantity>\r\n\
    \t\t<SpectralData wavelength=\"400.0\">0.034</SpectralData>\r\n\
    \t\t<SpectralData wavelength=\"403.1\">0.037</SpectralData>\r\n\
    \t\t<SpectralData wavelength=\"405.5\">0.069</SpectralData>\r\n\t</SpectralDistribution>\r\n</IESTM2714>\r\n";

/// `CxF3`: a list with the step in a specification, points out of order, points repeated.
pub(super) const CXF: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<cc:CxF xmlns:cc=\"urn:any\">\n\
    <cc:FileInformation><cc:Creator>Nobody</cc:Creator></cc:FileInformation>\n<cc:Resources><cc:ObjectCollection>\n\
    <cc:Object ObjectType=\"Standard\" Name=\"list\" Id=\"1\"><cc:ColorValues>\n\
    <cc:ReflectanceSpectrum ColorSpecification=\"s1\" StartWL=\"380\">0.1 0.2\n0.3</cc:ReflectanceSpectrum>\n\
    </cc:ColorValues></cc:Object>\n\
    <cc:Object ObjectType=\"Standard\" Name=\"points\" Id=\"2\"><cc:ColorValues>\n<cc:CustomSpectrum>\n\
    <cc:SpectralPoint WL=\"385\">0.50</cc:SpectralPoint>\n<cc:SpectralPoint WL=\"380.5\">0.45</cc:SpectralPoint>\n\
    <cc:SpectralPoint WL=\"392.1\">0.48</cc:SpectralPoint>\n</cc:CustomSpectrum>\n</cc:ColorValues>\n</cc:Object>\n\
    <cc:Object ObjectType=\"Standard\" Name=\"twice\" Id=\"3\">\n<cc:ColorValues>\n<cc:CustomSpectrum>\n\
    <cc:SpectralPoint WL=\"400\">0.50</cc:SpectralPoint>\n\n<cc:SpectralPoint WL=\"450\">0.50</cc:SpectralPoint>\n\
    <cc:SpectralPoint WL=\"450\">0.75</cc:SpectralPoint>\n</cc:CustomSpectrum></cc:ColorValues></cc:Object>\n\
    </cc:ObjectCollection>\n<cc:ColorSpecificationCollection><cc:ColorSpecification Id=\"s1\"><cc:MeasurementSpec>\n\
    <cc:WavelengthRange StartWL=\"380\" Increment=\"3.3\"/></cc:MeasurementSpec></cc:ColorSpecification>\n\
    </cc:ColorSpecificationCollection></cc:Resources></cc:CxF>\n";

/// rawtoaces: wavelengths as keys.
pub(super) const RAWTOACES: &str = "{\n    \"header\": { \"schema_version\" : \"1.0.0\", \"manufacturer\" : \"Nobody\",\n\
    \"model\" : \"N1\", \"measurement_equipment\" : null },\n    \"spectral_data\": {\n        \"units\" : \"relative\",\n\
    \"index\": { \"main\": [\"R\", \"G\", \"B\"] },\n\"data\": { \"main\": { \"1000\": [0.03, 0.01, 0.02], \"385\": [0.04, 0.02, 0.01],\n\
    \"380\": [ 0.0200000,     0.0300000,     0.0400000 ]\n            } } } }\n";

/// dcamprof: comments after `//`, bands as a range.
pub(super) const DCAMPROF: &str = "// made up, see http://nowhere\n{\n  // the \"name\"\n\
    \x20 \"camera_name\": \"Made // up \\\"N1\\\"\",\n\n  \"ssf_bands\": [ 400, 420, 10 ], // 400nm to 420nm\n\
    \x20 \"red_ssf\": [\n    0.1, 0.5,\n    1\n  ],\n  \"green_ssf\": [ 0.1, 0.3, 0.2 ],\n\
    \x20 \"blue_ssf\": [ 1.0, 0.0045,0.2 ]\n}";

/// Sekonic: keys and values, then a block by 5 nm and one by 1 nm under the same labels, then more keys.
pub(super) fn sekonic(label: &str) -> String {
    let mut text = String::from("Date Saved,15/03/2021 3:44:14 p.m.\nTitle,lamp_1°\n\nTcp [K],3262\n⊿uv,-0.0029\n");
    text += "Peak Wavelength [nm],608\nSSI1,---\n\n";
    for i in 0..5_u32 {
        text += &format!("{label}{}[nm],{:.12}\n", 380 + 5 * i, f64::from(5 * i) / 1000.0);
    }
    text += "\n";
    for i in 0..21_u32 {
        text += &format!("{label}{}[nm],{:.12}\n", 380 + i, f64::from(i) / 1000.0);
    }
    text + "TM-30 Color Vector Bin 1,---\n"
}
