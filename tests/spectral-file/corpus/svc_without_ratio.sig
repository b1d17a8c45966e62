/*** Spectra Vista SIG Data ***/
name= leaf_8.sig
units= Counts, Counts
data= 
400.0  1000.00  50.00
410.0  2000.00  200.00
420.0  4000.00  1000.00
