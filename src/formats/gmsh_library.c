/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/gmsh_library.h"

#include "core/error.h"

#include <dlfcn.h>
#include <string.h>

static OstStatus find_function(OstGmsh *gmsh, void *library, const char *name, void *field)
{
    void *symbol = dlsym(library, name);
    if (!symbol)
        return OST_RAISE(gmsh->ctx, OST_LIBRARY_FAILED,
                         "%s: Gmsh's library " ORTHOSTAT_GMSH_SONAME " has no function %s; install the version that "
                         "Orthostat was built with",
                         gmsh->path, name);
    memcpy(field, &symbol, sizeof symbol);
    return OST_SUCCESS;
}

OstStatus ost_gmsh_open(OstContext *ctx, const char *path, OstGmsh *gmsh)
{
    int error = 0;
    *gmsh = (OstGmsh){.ctx = ctx, .path = path};
    void *library = dlopen(ORTHOSTAT_GMSH_SONAME, RTLD_NOW | RTLD_LOCAL);
    if (!library)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "%s: reading it needs Gmsh's library, which could not be loaded: %s",
                         path, dlerror());
#define OST_GMSH_FIND(field, name) OST_TRY(find_function(gmsh, library, #name, &gmsh->field));
    OST_GMSH_FUNCTIONS(OST_GMSH_FIND)
#undef OST_GMSH_FIND
    gmsh->initialize(0, NULL, 0, &error);
    OST_TRY(ost_gmsh_check(gmsh, error, "start"));
    gmsh->set_number("General.Terminal", 0.0, &error);
    return ost_gmsh_check(gmsh, error, "be silenced");
}

void ost_gmsh_close(OstGmsh *gmsh)
{
    int error = 0;
    if (gmsh->finalize)
        gmsh->finalize(&error);
    *gmsh = (OstGmsh){0};
}

OstStatus ost_gmsh_check(const OstGmsh *gmsh, int error, const char *action)
{
    if (error == 0)
        return OST_SUCCESS;
    char *text = NULL;
    int ignored = 0;
    gmsh->last_error(&text, &ignored);
    const OstStatus status = OST_RAISE(gmsh->ctx, OST_INVALID_INPUT, "%s: Gmsh could not %s: %s", gmsh->path, action,
                                       text && *text ? text : "it gives no reason");
    gmsh->free(text);
    return status;
}
