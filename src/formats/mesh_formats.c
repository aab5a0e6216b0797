/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/mesh_formats.h"

#include "formats/exchange/exchange.h"
#include "formats/exodus/exodus.h"
#include "formats/serial/input_file.h"
#include "formats/vtk/vtk.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

const OstMeshFormat ost_mesh_formats[] = {
    {".msh", 0, ost_msh_read, NULL, ost_msh_read_field},
    {".msh.gz", 0, ost_msh_read, NULL, ost_msh_read_field},
    {".vtkhdf", 1, ost_vtk_read, NULL, ost_vtk_read_field},
    {".hdf", 1, ost_vtk_read, NULL, ost_vtk_read_field}, /* a VTKHDF file as ParaView 5.11 knows it */
    {".vtu", 0, ost_vtk_read, NULL, ost_vtk_read_field},
    {".pvtu", 0, ost_vtk_read, NULL, ost_vtk_read_field},
    {".vtk", 0, ost_vtk_read, NULL, ost_vtk_read_field},
    {".inp", 0, ost_abaqus_read, NULL, NULL},
    {".mesh", 0, ost_medit_read, NULL, NULL},
    {".meshb", 0, ost_medit_read, NULL, NULL},
    {".bdf", 0, ost_nastran_read, NULL, NULL},
    {".nas", 0, ost_nastran_read, NULL, NULL},
    {".fem", 0, ost_nastran_read, NULL, NULL}, /* OptiStruct's */
    {".unv", 0, ost_unv_read, NULL, NULL},
    {".node", 0, ost_tetgen_read, NULL, NULL},
    {".ele", 0, ost_tetgen_read, NULL, NULL},
#ifdef ORTHOSTAT_EXODUS
    {".exo", 0, ost_exodus_read, NULL, ost_exodus_read_field},
    {".ex2", 0, ost_exodus_read, NULL, ost_exodus_read_field},
    {".e", 0, ost_exodus_read, NULL, ost_exodus_read_field},
    {".g", 0, ost_exodus_read, NULL, ost_exodus_read_field},
    {".gen", 0, ost_exodus_read, NULL, ost_exodus_read_field},
#endif
    {".veg", 0, NULL, ost_veg_read, NULL},
};
const int ost_mesh_format_count = sizeof ost_mesh_formats / sizeof *ost_mesh_formats;

/* The way from other formats to one that is read. */
typedef enum {
    BY_MESHIO,
    BY_MESHIO_HDF5,
    BY_MESHIO_NETCDF,
    BY_MESHIO_MED,
    BY_MESHIO_AVS,
    BY_MESHIO_NETGEN,
    BY_MESHIO_TECPLOT,
    MESH_SOLID,
    MESH_SURFACE,
    SURFACE_BY_MESHIO,
    FROM_CAD,
    FROM_CUBIT,
    FROM_ASTER,
    FROM_ELMER,
    UNPACK_GZIP,
    UNPACK_BZIP2,
    UNPACK_XZ,
    UNPACK_ZIP,
    BY_PARAVIEW,
    BY_FILTER,
    BY_EXPORT,
    IS_CASE,
    BESIDE
} Way;

/* Debian's python3-meshio has no command of its own. */
#define MESHIO(FROM, TO) "python3 -c \"import meshio; meshio.read('" FROM "').write('" TO ".vtu')\""

static const char *const way_words[] = {
    [BY_MESHIO] = "convert it: " MESHIO("%s", "%.*s") " (Debian: python3-meshio)",
    [BY_MESHIO_HDF5] = "convert it: " MESHIO("%s", "%.*s") " (Debian: python3-meshio, python3-h5py)",
    [BY_MESHIO_NETCDF] = "convert it: " MESHIO("%s", "%.*s") " (Debian: python3-meshio, python3-netcdf4)",
    [BY_MESHIO_MED] =
        "convert it: python3 -c \"import meshio; meshio.read('%s', file_format='med').write('%.*s.vtu')\" "
        "(Debian: python3-meshio, python3-h5py)",
    [BY_MESHIO_AVS] = "convert it: python3 -c \"import meshio; meshio.read('%s', "
                      "file_format='avsucd').write('%.*s.vtu')\" (Debian: python3-meshio)",
    [BY_MESHIO_NETGEN] =
        "convert it: python3 -c \"import meshio; m = meshio.read('%s'); m.cell_data['gmsh:physical'] = "
        "m.cell_data['netgen:index']; m.write('%.*s.msh', file_format='gmsh22')\" (Debian: "
        "python3-meshio)",
    [BY_MESHIO_TECPLOT] =
        "convert it: " MESHIO("%s", "%.*s") " (Debian: python3-meshio), or, where that fails, open it "
                                            "in ParaView and save it as .vtu (File, Save Data)",
    [MESH_SOLID] = "mesh it: gmsh -3 %s -o %.*s.msh",
    [MESH_SURFACE] = "it holds a surface; fill it with tets: tetgen -pq %s and take %.*s.1.ele, or mesh it with gmsh",
    [SURFACE_BY_MESHIO] = "it holds a surface; convert it, python3 -c \"import meshio; "
                          "meshio.read('%s').write('%.*s.stl')\", then fill it with tets: tetgen -pq on the .stl",
    [FROM_CAD] = "export %s from its program as %.*s.step, and mesh that with gmsh -3",
    [FROM_CUBIT] = "export %s from Cubit as %.*s.e (Exodus)",
    [FROM_ASTER] = "read %s in Code_Aster or Salome, and export %.*s.med; meshio converts that",
    [FROM_ELMER] = "take the mesh that %s was made from, or convert its folder: ElmerGrid 2 4 FOLDER writes a .msh%.*s",
    [UNPACK_GZIP] = "unpack it: gunzip -k %s, and take %.*s",
    [UNPACK_BZIP2] = "unpack it: bunzip2 -k %s, and take %.*s",
    [UNPACK_XZ] = "unpack it: unxz -k %s, and take %.*s",
    [UNPACK_ZIP] = "unpack it: unzip %s, and take the mesh that %.*s held",
    [BY_PARAVIEW] = "open %s in ParaView, and save it as %.*s.vtu (File, Save Data)",
    [BY_FILTER] = "open %s in ParaView, apply Tetrahedralize, and save it as %.*s.vtu (File, Save Data)",
    [IS_CASE] = "is it a case? Then 'orthostat check %s' reads it, with its mesh",
    [BESIDE] = "take the mesh that %s is a part of: %.*s.ele",
    [BY_EXPORT] = "export %s from its program as %.*s.inp (Abaqus), or .bdf (Nastran), .unv, .vtk",
};

static const struct {
    const char *ending, *what;
    Way way;
} others[] = {
    {".yaml", "YAML", IS_CASE},
    {".yml", "YAML", IS_CASE},
#ifndef ORTHOSTAT_EXODUS
    {".exo", "Exodus", BY_MESHIO_NETCDF},
    {".ex2", "Exodus", BY_MESHIO_NETCDF},
    {".e", "Exodus", BY_MESHIO_NETCDF},
    {".g", "Exodus", BY_MESHIO_NETCDF},
    {".gen", "Exodus", BY_MESHIO_NETCDF},
#endif
    {".xdmf", "XDMF", BY_MESHIO_HDF5},
    {".xmf", "XDMF", BY_MESHIO_HDF5},
    {".xml", "DOLFIN", BY_MESHIO},
    {".su2", "SU2", BY_MESHIO},
    {".h5m", "MOAB", BY_MESHIO_HDF5},
    {".vol", "Netgen", BY_MESHIO_NETGEN},
    {".vol.gz", "Netgen", BY_MESHIO_NETGEN},
    {".avs", "AVS", BY_MESHIO},
    {".f3grid", "FLAC3D", BY_MESHIO},
    {".post", "PERMAS", BY_MESHIO},
    {".dato", "PERMAS", BY_MESHIO},
    {".ugrid", "UGRID", BY_MESHIO},
    {".mdpa", "Kratos", BY_MESHIO},
    {".dat", "Tecplot (one of Nastran: name it .bdf; of Abaqus: .inp)", BY_MESHIO_TECPLOT},
    {".tec", "Tecplot", BY_MESHIO_TECPLOT},
    {".tp", "Tecplot", BY_PARAVIEW},
    {".plt", "Tecplot (binary)", BY_PARAVIEW},
    {".szplt", "Tecplot (binary)", BY_EXPORT},
    {".med", "MED (Salome, Code_Aster)", BY_MESHIO_HDF5},
    {".cgns", "CGNS", BY_PARAVIEW},
    {".p3d", "Plot3D", BY_PARAVIEW},
    {".geo", "Gmsh's model", MESH_SOLID},
    {".geo_unrolled", "Gmsh's model", MESH_SOLID},
    {".face", "TetGen's faces alone", BESIDE},
    {".edge", "TetGen's edges alone", BESIDE},
    {".step", "STEP", MESH_SOLID},
    {".stp", "STEP", MESH_SOLID},
    {".iges", "IGES", MESH_SOLID},
    {".igs", "IGES", MESH_SOLID},
    {".brep", "OpenCASCADE", MESH_SOLID},
    {".stl", "STL", MESH_SURFACE},
    {".ply", "PLY", MESH_SURFACE},
    {".off", "OFF", MESH_SURFACE},
    {".poly", "TetGen's input", MESH_SURFACE},
    {".smesh", "TetGen's input", MESH_SURFACE},
    {".obj", "Wavefront", SURFACE_BY_MESHIO},
    {".vtm", "VTK in blocks", BY_PARAVIEW},
    {".vtp", "VTK polygons", BY_PARAVIEW},
    {".vti", "VTK images", BY_FILTER},
    {".vts", "VTK's structured grids", BY_FILTER},
    {".vtr", "VTK's rectilinear grids", BY_FILTER},
    {".pvd", "ParaView's list", BY_PARAVIEW},
    {".case", "EnSight", BY_PARAVIEW},
    {".foam", "OpenFOAM", BY_PARAVIEW},
    {".frd", "CalculiX's result", BY_EXPORT},
    {".cdb", "ANSYS", BY_EXPORT},
    {".mphtxt", "COMSOL", BY_EXPORT},
    {".k", "LS-DYNA", BY_EXPORT},
    {".key", "LS-DYNA", BY_EXPORT},
    {".feb", "FEBio", BY_EXPORT},
    {".odb", "Abaqus's result", BY_EXPORT},
    {".cae", "Abaqus/CAE", BY_EXPORT},
    {".dyn", "LS-DYNA", BY_EXPORT},
    {".rad", "OpenRadioss", BY_EXPORT},
    {".mphbin", "COMSOL", BY_EXPORT},
    {".xplt", "FEBio's result", BY_EXPORT},
    {".neu", "Gambit or Netgen", BY_EXPORT},
    {".am", "Amira", BY_EXPORT},
    {".tet", "Quartet", BY_EXPORT},
    {".hm", "HyperMesh", BY_EXPORT},
    {".mechdat", "ANSYS", BY_EXPORT},
    {".wbpj", "ANSYS", BY_EXPORT},
    {".db", "ANSYS", BY_EXPORT},
    {".op2", "Nastran's result", BY_EXPORT},
    {".f06", "Nastran's result", BY_EXPORT},
    {".pch", "Nastran's result", BY_EXPORT},
    {".FCStd", "FreeCAD", BY_EXPORT},
    {".dgf", "DUNE", BY_EXPORT},
    {".mesh3d", "Hermes", BY_EXPORT},
    {".mmed", "MED (Code_Aster)", BY_MESHIO_MED},
    {".rmed", "MED (Code_Aster)", BY_MESHIO_MED},
    {".mail", "Code_Aster", FROM_ASTER},
    {".comm", "Code_Aster's commands", FROM_ASTER},
    {".ucd", "AVS", BY_MESHIO_AVS},
    {".header", "Elmer", FROM_ELMER},
    {".nodes", "Elmer", FROM_ELMER},
    {".elements", "Elmer", FROM_ELMER},
    {".boundary", "Elmer", FROM_ELMER},
    {".cub", "Cubit", FROM_CUBIT},
    {".cub5", "Cubit", FROM_CUBIT},
    {".trelis", "Cubit", FROM_CUBIT},
    {".sldprt", "SolidWorks", FROM_CAD},
    {".ipt", "Inventor", FROM_CAD},
    {".x_t", "Parasolid", FROM_CAD},
    {".sat", "ACIS", FROM_CAD},
    {".3mf", "3MF", FROM_CAD},
    {".zip", "zip", UNPACK_ZIP},
    {".gz", "gzip", UNPACK_GZIP}, /* after those that are read as they are */
    {".bz2", "bzip2", UNPACK_BZIP2},
    {".xz", "xz", UNPACK_XZ},
};

enum { LONGEST_NAME = 512 };

/* The name without its folders; as a shell takes it outside of quotes, blanks follow a backslash. */
static void name_of(const char *path, int quoted, char *name, size_t size)
{
    const char *from = strrchr(path, '/');
    size_t length = 0;
    for (from = from ? from + 1 : path; *from && length + 2 < size; from++) {
        if (*from == ' ' && !quoted)
            name[length++] = '\\';
        name[length++] = *from;
    }
    name[length] = '\0';
}

static int is_folder(const char *path)
{
    struct stat of;
    return stat(path, &of) == 0 && S_ISDIR(of.st_mode);
}

void ost_mesh_format_advice(const char *path, char *text, size_t size)
{
    char name[LONGEST_NAME];
    for (size_t o = 0; o < sizeof others / sizeof *others; o++)
        if (ost_has_ending(path, others[o].ending)) {
            const int used = snprintf(text, size, "files of %s are not read; ", others[o].what);
            name_of(path, others[o].way <= BY_MESHIO_TECPLOT, name, sizeof name);
            const int stem = others[o].way == FROM_ELMER ? 0 : (int)(strlen(name) - strlen(others[o].ending));
            if (used > 0 && (size_t)used < size)
                snprintf(text + used, size - (size_t)used, way_words[others[o].way], name, stem, name);
            return;
        }
    name_of(path, 1, name, sizeof name);
    const char *dot = strrchr(name, '.');
    int used = is_folder(path)
                   ? snprintf(text, size,
                              "is a folder; name the mesh in it (one of Elmer: ElmerGrid 2 4 FOLDER writes a "
                              ".msh); read are")
                   : snprintf(text, size, "the ending '%s' is not that of a mesh file; read are", dot ? dot : "");
    for (int f = 0; f < ost_mesh_format_count && used > 0 && (size_t)used < size; f++)
        used += snprintf(text + used, size - (size_t)used, "%s %s", f > 0 ? "," : "", ost_mesh_formats[f].ending);
    if (used > 0 && (size_t)used < size)
        snprintf(text + used, size - (size_t)used,
                 "; export it as one of these from the program that it is of, or convert it by meshio or gmsh if they "
                 "know it");
}
