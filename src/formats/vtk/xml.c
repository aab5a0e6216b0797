/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtk/xml.h"

#include "core/error.h"

#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\r\n";

static int is_blank(char c)
{
    return c != '\0' && strchr(blanks, c) != NULL;
}

/* Copies what does not end with one of `ends`; truncates. */
static const char *copy_until(const char *at, const char *end, const char *ends, char text[OST_XML_VALUE])
{
    size_t length = 0;
    for (; at < end && *at && !strchr(ends, *at); at++)
        if (length + 1 < OST_XML_VALUE)
            text[length++] = *at;
    text[length] = '\0';
    return at;
}

/* Name="value" or Name='value', between blanks, up to the end of the tag. */
static const char *read_attributes(const char *at, const char *end, OstXmlTag *tag)
{
    while (at < end && *at != '>') {
        const int a = tag->count < OST_XML_ATTRIBUTES ? tag->count : OST_XML_ATTRIBUTES - 1;
        if (is_blank(*at) || *at == '\0') {
            at++;
        } else if (*at == '/') {
            tag->closes = 2;
            at++;
        } else {
            at = copy_until(at, end, " \t\r\n=>/", tag->attribute[a]);
            while (at < end && is_blank(*at))
                at++;
            if (at >= end || *at != '=')
                continue;
            for (at++; at < end && is_blank(*at);)
                at++;
            const char quote[2] = {at < end ? *at : '\0', '\0'};
            if (*quote != '"' && *quote != '\'')
                continue;
            at = copy_until(at + 1, end, quote, tag->value[a]);
            at += at < end;
            tag->count = a + 1;
        }
    }
    return at;
}

OstStatus ost_xml_next(OstMshCursor *cursor, OstXmlTag *tag, int *found)
{
    const char *end = cursor->end;
    *found = 0;
    for (;;) {
        const char *at = memchr(cursor->next, '<', (size_t)(end - cursor->next));
        if (!at)
            return OST_SUCCESS;
        cursor->place = at++;
        if (at < end && (*at == '!' || *at == '?')) {
            const int comment = end - at >= 3 && memcmp(at, "!--", 3) == 0;
            const char *close = memmem(at, (size_t)(end - at), comment ? "-->" : ">", comment ? 3 : 1);
            cursor->next = close ? close + (comment ? 3 : 1) : end;
            continue;
        }
        memset(tag, 0, sizeof *tag);
        tag->closes = at < end && *at == '/';
        at = copy_until(at + tag->closes, end, " \t\r\n>/", tag->name);
        at = read_attributes(at, end, tag);
        if (at >= end)
            return OST_RAISE_MSH(cursor, "the tag <%s does not end; the file is incomplete, write it again", tag->name);
        cursor->next = at + 1;
        *found = 1;
        return OST_SUCCESS;
    }
}

const char *ost_xml_value(const OstXmlTag *tag, const char *attribute)
{
    for (int a = 0; a < tag->count; a++)
        if (strcmp(tag->attribute[a], attribute) == 0)
            return tag->value[a];
    return NULL;
}

OstStatus ost_xml_number(OstMshCursor *cursor, const OstXmlTag *tag, const char *attribute, OstGlobal missing,
                         OstGlobal *number)
{
    const char *text = ost_xml_value(tag, attribute);
    char *end = NULL;
    *number = text ? strtoll(text, &end, 10) : missing;
    if (!text || (*text && *end == '\0' && *number >= 0 && *number <= OST_LARGEST_LABEL))
        return OST_SUCCESS;
    return OST_RAISE_MSH(cursor, "%s=\"%s\" found, expected a whole number", attribute, text);
}
