/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/json_file.h"

#include "core/error.h"
#include "core/write_aside.h"

#include <math.h>
#include <string.h>

json_t *ost_json_number(double number)
{
    return isfinite(number) ? json_real(number) : json_null();
}

typedef struct Document {
    OstContext *ctx;
    const json_t *root;
} Document;

static OstStatus dump(FILE *file, const void *content)
{
    const Document *document = content;
    if (json_dumpf(document->root, file, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) != 0 && !ferror(file))
        return OST_RAISE(document->ctx, OST_OUT_OF_MEMORY, "out of memory for the text of a JSON file");
    fputc('\n', file);
    return OST_SUCCESS;
}

json_t *ost_json_text(const char *text)
{
    enum { LONGEST_CHARACTER = 4 };
    const size_t length = strlen(text);
    json_t *json = json_string(text);
    for (size_t less = 1; !json && less < LONGEST_CHARACTER && less <= length; less++)
        json = json_stringn(text, length - less);
    return json;
}

json_t *ost_json_warnings(const OstContext *ctx)
{
    json_t *warnings = json_array();
    for (int i = 0; i < ost_warning_count(ctx); i++)
        json_array_append_new(warnings, ost_json_text(ost_warning(ctx, i)));
    return warnings;
}

OstStatus ost_json_write(OstContext *ctx, json_t *document, const char *path)
{
    const Document content = {ctx, document};
    const OstStatus status = ost_write_aside(ctx, path, dump, &content);
    json_decref(document);
    return status;
}
