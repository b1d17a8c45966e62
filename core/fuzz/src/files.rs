//! Small sound files of every family, with made-up numbers.

/// Each file with a name for it.
pub const ALL: [(&str, &str); 31] = [
    ("commas", "# title: a\n# unit: percent\nwavelength_nm,R,G,B\n380,0.1,0.2,0.3\n390,0.2,0.3,0.4\n400,,0.4,0.5\n"),
    (
        "semicolons",
        "Wave ;Sample;Reflectance\r\n[nm] ;[counts];[%]\r\n\r\n 300,00; -6,893;52,5\r\n 301,00; -7,4; 0,0\r\n",
    ),
    ("spaces", "\" File: x\n\" T->  Wave:7.2nm\n 339.00  1.0E-003\n 339.50  1.0E-003\n 340.00  NaN\n"),
    ("tabs", "X Units: Wavelength (micrometers)\nY Units: Reflectance (percent)\n\n0.40\t5\t\n0.39\t6\t\n0.38\t7\t\n"),
    ("across", "wavelength\t380\t385\t390\t395\t400\n1\t0.1\t0.2\t0.3\t0.4\t0.5\n2\t0.2\t0.3\t\t0.5\t0.6\n"),
    ("quotes", "a,\"b, c\",400,410,420,430,440\nx,\"y \"\"z\",1,2,3,4,5\nx,y,1,2,3,4,5\n"),
    ("pixels", "Pixel,Wavelength,P\n0,380.5,1\n1,381.5,2\n2,382.5,3\n>>>>>End<<<<<\n"),
    ("two tables", "nm,a\n400,1\n410,2\n420,3\n\nnm,b\n400,3\n410,4\n420,5\n"),
    (
        "bands",
        "Name;L*;SCI 360nm;SCI 370nm;SCI 380nm;SCI 390nm;SCI 400nm;Note\na;50,1;1,5;2;3;4;5;x\nb;51,1;2,5;3;4;5;6;\n",
    ),
    ("units", "nm,A,note\n400,4.0%,x\n410,5.0%,y\n420,6.5%,\n"),
    ("again", "sample,nm,R\nleaf,400,0.1\nleaf,410,0.2\nleaf,420,0.3\nbark,400,0.2\nbark,410,0.3\nbark,410,0.4\n"),
    ("commas twice", "400,0,060\n410,0,070\n420,0,085\n"),
    ("pairs", "Wavelength (nm),%R,Wavelength (nm),%R\n380,1,380,2\n390,1,390,2\n400,5,400,6\n"),
    (
        "argyll",
        "SPECT\n\nDESCRIPTOR \"Lamp\"\nSPECTRAL_BANDS \"3\"\nSPECTRAL_START_NM \"300.0\"\nSPECTRAL_END_NM \"310.0\"\n\
                SPECTRAL_NORM \"100.0\"\nNUMBER_OF_FIELDS 3\nBEGIN_DATA_FORMAT\nSPEC_300 SPEC_305 SPEC_310\nEND_DATA_FORMAT\n\
                NUMBER_OF_SETS 1\nBEGIN_DATA\n0.0 25.0 57.82\nEND_DATA\n",
    ),
    (
        "cgats",
        "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_NAME nm380 nm390 nm400\nEND_DATA_FORMAT\nBEGIN_DATA\n\
               \"a \"\"b\"\"\" 0.1 0.2 -9999 # note\nc 0,1 0,2 0,3\nEND_DATA\n",
    ),
    (
        "cgats pairs",
        "CGATS.17\nBEGIN_DATA_FORMAT\nSAMPLE_ID SPECTRAL_NM SPECTRAL_PCT SPECTRAL_NM SPECTRAL_PCT\nEND_DATA_FORMAT\n\
                     BEGIN_DATA\n1 400 5 410 6\n2 400 50 410 60\nEND_DATA\n",
    ),
    (
        "jcamp blocks",
        "##TITLE= A\n##DATA TYPE= LINK\n##BLOCKS= 2\n##TITLE= PROCESSED SPECTRUM\n##JCAMP-DX= 5 $$x\n\
                      ##DATA TYPE= UV/VIS SPECTRUM\n##XUNITS= NANOMETERS\n##YUNITS= Transmission (%)\n##NPOINTS= 3\n\
                      ##XYPOINTS= (XY..XY)\n400.5, 25.0\n401.0, 30.0\n401.5, 35.0\n##END=\n##TITLE= DARK SPECTRUM\n\
                      ##XUNITS= NANOMETERS\n##NPOINTS= 2\n##XYPOINTS= (XY..XY)\n400.5, 10.0\n401.0, 11.0\n##END=\n##END=\n",
    ),
    (
        "jcamp squeezed",
        "##TITLE= leaf\n##JCAMP-DX= 4.24\n##XUNITS= NANOMETERS\n##YUNITS= REFLECTANCE\n##XFACTOR= 1.0\n\
                        ##YFACTOR= 0.001\n##FIRSTX= 400\n##LASTX= 440\n##NPOINTS= 5\n##XYDATA= (X++(Y..Y))\n\
                        400A00J0T%\n430A20p0\n##END=\n",
    ),
    (
        "tm27",
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<IESTM2714 xmlns=\"iestm2714\"><Header><Description>A &amp; b</Description>\
              </Header>\r\n<SpectralDistribution><SpectralQuantity>relative</SpectralQuantity>\r\n\
              <SpectralData wavelength=\"400.0\">0.034</SpectralData><SpectralData wavelength='403.1'>0.037</SpectralData>\
              </SpectralDistribution></IESTM2714>\r\n",
    ),
    (
        "cxf",
        "<?xml version=\"1.0\"?><!-- x --><cc:CxF xmlns:cc=\"u\"><cc:FileInformation><cc:Creator>N</cc:Creator></cc:FileInformation>\
             <cc:Object Name=\"l\" Id=\"1\"><cc:ReflectanceSpectrum ColorSpecification=\"s\" StartWL=\"380\">0.1 <![CDATA[0.2]]>\n\
             0.3</cc:ReflectanceSpectrum></cc:Object><cc:Object Name=\"p\"><cc:CustomSpectrum><cc:SpectralPoint WL=\"385\">.5\
             </cc:SpectralPoint><cc:SpectralPoint WL=\"380.5\">0.4&#53;</cc:SpectralPoint></cc:CustomSpectrum></cc:Object>\
             <cc:ColorSpecification Id=\"s\"><cc:WavelengthRange StartWL=\"380\" Increment=\"3.3\"/></cc:ColorSpecification></cc:CxF>",
    ),
    (
        "rawtoaces",
        "{\"header\": {\"model\": \"N1\", \"x\": null}, \"spectral_data\": {\"units\": \"relative\", \"index\": {\"main\": \
                   [\"R\", \"G\", \"B\"]}, \"data\": {\"main\": {\"1000\": [0.03, 0.01, 0.02], \"385\": [0.04, 0.02, 0.01], \
                   \"380\": [0.02, 0.03, 0.04]}}}}\n",
    ),
    (
        "dcamprof",
        "// made up\n{ \"camera_name\": \"a // b\", \"ssf_bands\": [ 400, 420, 10 ], // nm\n\"red_ssf\": [ 0.1, 0.5, 1 ],\n\
                  \"green_ssf\": [ 0.1, 0.3, 0.2 ], \"blue_ssf\": [ 1.0, 0.0045, 0.2 ] }\n",
    ),
    ("dcamprof light", "{ \"bands\": [ 400, 420, 10 ], \"scale\": 0.5, \"spectrum\": [ 0.1, 0.5, 1 ] }\n"),
    (
        "json lists",
        "{\"units\": {\"wavelength\": \"um\"}, \"leaf\": {\"wavelength\": [0.4, 0.5, 0.6], \"reflectance\": [0.1, null, 0.3], \"sd\": [0, 0, 0]},\n\
                    \"lamp\": {\"start\": 400, \"end\": 420, \"step\": 10, \"values\": [[1, 2], [3, 4], [5, 6]]}}\n",
    ),
    (
        "json records",
        "[{\"sample\": \"a\", \"wavelength\": 400, \"R\": 1}, {\"sample\": \"a\", \"wavelength\": 410, \"R\": 2}, {\"sample\": \"b\", \
                    \"wavelength\": 400, \"R\": 1e1}, {\"sample\": \"b\", \"wavelength\": 410, \"R\": 2}]\n",
    ),
    (
        "labels",
        "Title,lamp\nTcp [K],3262\n\nSpectral Data 380[nm],0.1\nSpectral Data 381[nm],0.2\nSpectral Data 382[nm],0.3\n\
                Spectral Data 383[nm],0.25\nSpectral Data 384[nm],0.2\nSpectral Data 385[nm],0.1\n",
    ),
    ("alternate", "@19/5/1997\n@12:00\n#No Title\n 2.5E+02\n 0.0E+00\n 2.51E+02\n 1.5E-04\n 2.52E+02\n 2,5E-04\n"),
    (
        "camspec",
        "Made up 1D\r\n\
        0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0.1 0.5 1 0.9 0.8 0.7 0.6 0.5 0.4 0.3 0.2 0.1 0 0 0\r\n\
        0 0 0 0 0 0 0 0 0.1 0.5 1 0.9 0.8 0.7 0.6 0.5 0.4 0.3 0.2 0.1 0 0 0 0 0 0 0 0 0 0 0 0 0\r\n\
        0 0.1 0.5 1 0.9 0.8 0.7 0.6 0.5 0.4 0.3 0.2 0.1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\r\n",
    ),
    ("latin", "nm;R (µm);°\n0,4;1;2\n0,5;3;4\n0,6;5;−6\n"),
    ("svc",
    "/*** Spectra Vista SIG Data ***/\nname= a.sig\nunits= Radiance, Radiance\ndata= \n400.0  1.0  2.0  5.0\n420.0  1.0  2.0  6.0\n\
     410.0  1.0  2,0  NaN\n430.0  1.0  2.0  8.0\n"
    ),("perkinelmer",
    "PE UV       SUBTECH     SPECTRUM    ASCII       PEDS        4.00        \n  -1\na.asc\n#HDR\n-1\n#GR\nnm\n%R\n1.0\n0.0\n410.0\n-10.0\n2\n\
     #DATA\n410.0\t5.0\n400,0\t6.0\n"
    ),
];
