/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/series.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/write_aside.h"
#include "formats/vtu/vtu.h"

#include <string.h>

typedef struct Series {
    int count;
    const OstSeriesFile *files;
} Series;

/* Without the folder: it is found beside the list. */
static const char *name_beside(const char *name)
{
    const char *slash = strrchr(name, '/');
    return slash ? slash + 1 : name;
}

static OstStatus write_collection(FILE *file, const void *content)
{
    const Series *series = content;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n", file);
    for (int i = 0; i < series->count; i++) {
        fprintf(file, "<DataSet timestep=\"%.17g\" file=\"", series->files[i].time);
        ost_xml_write(file, name_beside(series->files[i].name));
        fputs("\"/>\n", file);
    }
    fputs("</Collection>\n</VTKFile>\n", file);
    return OST_SUCCESS;
}

static OstStatus write_json(OstContext *ctx, const char *list, const Series *series)
{
    json_t *files = json_array();
    for (int i = 0; i < series->count; i++)
        json_array_append_new(files, json_pack("{s:o, s:f}", "name", ost_json_text(name_beside(series->files[i].name)),
                                               "time", series->files[i].time));
    json_t *document = json_pack("{s:s, s:o}", "file-series-version", "1.0", "files", files);
    return document ? ost_json_write(ctx, document, list)
                    : OST_RAISE(ctx, OST_LIBRARY_FAILED, "the list of files '%s' cannot be written as JSON", list);
}

OstStatus ost_series_write(OstContext *ctx, const char *list, int count, const OstSeriesFile *files)
{
    const Series series = {count, files};
    const char *dot = strrchr(list, '.');
    return dot && strcmp(dot, ".pvd") == 0 ? ost_write_aside(ctx, list, write_collection, &series)
                                           : write_json(ctx, list, &series);
}
