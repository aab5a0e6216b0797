/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exchange/nastran_names.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Number and name on one line. */
static int read_both(const char *comment, OstNastranName *name)
{
    static const char *const forms[] = {"$HMNAME PROP %" SCNd64 " \"%63[^\"]",           /* HyperMesh */
                                        "$ANSA_NAME_COMMENT;%" SCNd64 ";%*[^;];%63[^;]", /* ANSA */
                                        "$ Femap Property %" SCNd64 " : %63[^\n]",       /* Femap */
                                        "$ FEMAP Property %" SCNd64 " : %63[^\n]",       /* of old */
                                        "$ Femap with %*s Nastran Property %" SCNd64 " : %63[^\n]"};
    for (size_t f = 0; f < sizeof forms / sizeof *forms; f++)
        if (sscanf(comment, forms[f], &name->property, name->text) == 2)
            return 1;
    return 0;
}

/* A name whose number stands on the card that follows: Patran's and Simcenter's. */
static int read_next(const char *comment, OstNastranName *name)
{
    name->property = OST_NASTRAN_NEXT_PROPERTY;
    return sscanf(comment, "$ Elements and Element Properties for region : %63[^\n]", name->text) == 1 ||
           sscanf(comment, "$* Property: %63[^\n]", name->text) == 1;
}

void ost_nastran_take_comment(OstNastranName *name, const char *line, const char *end)
{
    char comment[256];
    OstNastranName found = {.property = OST_NASTRAN_NO_PROPERTY};
    snprintf(comment, sizeof comment, "%.*s", end - line < 255 ? (int)(end - line) : 255, line);
    if (name->property >= 0 && !name->text[0]) { /* the second line of ANSA's older form */
        snprintf(name->text, sizeof name->text, "%.63s", comment + 1);
        found = *name;
    } else if (sscanf(comment, "$ANSA_NAME;%" SCNd64 ";", &found.property) == 1) {
        *name = found;
        return;
    } else if (sscanf(comment, "$HMSET %" SCNd64 " %*d \"%63[^\"]", &found.set, found.text) != 2 &&
               !read_both(comment, &found) && !read_next(comment, &found))
        return;
    size_t length = strcspn(found.text, "\r");
    while (length > 0 && isspace((unsigned char)found.text[length - 1]))
        length--;
    found.text[length] = '\0';
    /* What Femap calls everything that has no name. */
    if (length == 0 || strcasecmp(found.text, "Untitled") == 0)
        found.property = OST_NASTRAN_NO_PROPERTY;
    *name = found;
}
