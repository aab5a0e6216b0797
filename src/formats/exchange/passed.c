/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exchange/passed.h"

#include "core/error.h"
#include "core/memory.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MOST_LINES = 12 };

const char ost_way_joined[] = "state what holds nodes together by rigid, tied_to or periodic, under constraints";
const char ost_way_contact[] = "there is no contact: faces that stay together can be tied_to each other";
const char ost_way_thin[] = "shells, membranes and beams add no stiffness: mesh what they stand for with solids";
const char ost_way_spring[] = "state springs and foundations under springs";
const char ost_way_axes[] = "material axes are those of the case: axes or fibre of each material";

static OstStatus count_word(OstContext *ctx, const OstPassedWay *way, OstPassed *passed)
{
    for (int w = 0; w < passed->count; w++)
        if (strcmp(passed->word[w].name, way->name) == 0) {
            passed->word[w].times++;
            return OST_SUCCESS;
        }
    OST_TRY(OST_RESIZE(ctx, &passed->word, passed->count + 1));
    struct OstPassedWord *last = &passed->word[passed->count++];
    *last = (struct OstPassedWord){.times = 1, .way = way->way};
    snprintf(last->name, sizeof last->name, "%s", way->name);
    return OST_SUCCESS;
}

/* `name` has no blanks. */
static int is_word(const char *way, const char *name)
{
    while (*way && (*way == ' ' || *way == *name))
        name += *way++ != ' ';
    return !*way && !*name;
}

OstStatus ost_passed_take(OstContext *ctx, const OstPassedWay *ways, size_t count, const char *name, OstPassed *passed)
{
    for (size_t w = 0; w < count; w++)
        if (is_word(ways[w].name, name))
            return count_word(ctx, &ways[w], passed);
    return OST_SUCCESS;
}

void ost_passed_line(OstPassed *passed, const char *format, ...)
{
    const size_t used = strlen(passed->text), room = sizeof passed->text - used;
    va_list arguments;
    va_start(arguments, format);
    const int length = passed->lines < MOST_LINES ? vsnprintf(passed->text + used, room, format, arguments) : -1;
    va_end(arguments);
    if (length < 0 || (size_t)length >= room) {
        passed->text[used] = '\0';
        passed->more++;
    } else {
        passed->lines++;
    }
}

void ost_passed_point(OstPassed *passed, const char *boundary, const char *at, int in_the_mean, const char *directions)
{
    const int all = !directions[0] || (strchr(directions, '1') && strchr(directions, '2') && strchr(directions, '3'));
    if (in_the_mean)
        ost_passed_line(passed, "\n  loads: - {on: {boundary: %s}, total_force: [fx, fy, fz], at: %s}", boundary, at);
    else if (all)
        ost_passed_line(passed, "\n  constraints: - {on: {boundary: %s}, rigid: %s}", boundary, at);
    else
        ost_passed_line(passed,
                        "\n  constraints: - {on: {boundary: %s}, rigid: %s} # holds more: the model couples %s alone",
                        boundary, at, directions);
}

const char *ost_yaml_name(const char *name, char text[OST_YAML_NAME])
{
    size_t length = 0;
    int plain = isalpha((unsigned char)name[0]);
    for (const char *c = name; *c; c++)
        plain = plain && (isalnum((unsigned char)*c) || strchr("_-.", *c));
    if (plain) {
        snprintf(text, OST_YAML_NAME, "%s", name);
        return text;
    }
    text[length++] = '"';
    for (const char *c = name; *c && length + 3 < OST_YAML_NAME; c++) {
        if (*c == '"' || *c == '\\')
            text[length++] = '\\';
        text[length++] = *c;
    }
    text[length++] = '"';
    text[length] = '\0';
    return text;
}

void ost_passed_warn(OstContext *ctx, const char *path, OstPassed *passed)
{
    char what[512] = "", ways[1024] = "";
    for (int w = 0; w < passed->count; w++) {
        const struct OstPassedWord *word = &passed->word[w];
        ost_append(what, sizeof what, "%s%s (%" PRId64 ")", w > 0 ? ", " : "", word->name, word->times);
        int known = word->way[0] == '\0';
        for (int before = 0; before < w && !known; before++)
            known = strcmp(passed->word[before].way, word->way) == 0;
        if (!known)
            ost_append(ways, sizeof ways, "; %s", word->way);
    }
    if (passed->count > 0 && passed->lines > 0)
        ost_warn(ctx, "%s: not read, but without it the body moves otherwise: %s%s. In the case file:%s%s", path, what,
                 ways, passed->text, passed->more > 0 ? "\n  ... and more of these" : "");
    else if (passed->count > 0)
        ost_warn(ctx, "%s: not read, but without it the body moves otherwise: %s%s", path, what, ways);
    OST_FREE(passed->word);
    *passed = (OstPassed){0};
}
