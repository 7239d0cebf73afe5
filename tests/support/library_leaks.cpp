// What LeakSanitizer passes over: libraries that lose memory over input they refuse.
// teem 1.12: 88 bytes an error in a header, from airArrayNew.
// udunits 2.2: the last word of a unit that it cannot parse, from its lexer.
// VTK 9.1: the colours and the arrays of a legacy file, and an XML array whose values end early.
// OpenVDB 10.0: the nodes of a tree whose file ends among them.
// netCDF 4.9 and HDF5 1.10: what they have of a file they refuse, such as headers of its objects.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:libteem.so\nleak:utlex\nleak:vtkLookupTable::New\nleak:vtkArrayIteratorTemplate\n"
           "leak:vtk*Array::New\nleak:libopenvdb.so\n"
           "leak:libnetcdf.so\nleak:libhdf5\n";
}
