/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/yaml/message.h"

#include "core/error.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MESSAGE_SIZE = 2048, WORD_SIZE = 64 };

OstStatus ost_yaml_raise(const OstYaml *yaml, const OstYamlNode *node, const char *format, ...)
{
    char message[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    const char *setting = ost_yaml_setting(yaml, node);
    if (setting)
        ost_append(message, sizeof message, " (set by %.200s)", setting);
    return OST_RAISE(yaml->ctx, OST_INVALID_INPUT, "%s:%d:%d: %s", yaml->path, ost_yaml_line(node),
                     (int)node->column + 1, message);
}

OstStatus ost_yaml_located(const OstYaml *yaml, const OstYamlNode *node, OstStatus status)
{
    if (status != OST_INVALID_INPUT)
        return status;
    char message[MESSAGE_SIZE];
    snprintf(message, sizeof message, "%s", ost_error_text(yaml->ctx));
    return ost_yaml_raise(yaml, node, "%s", message);
}

/* Appends the child of `parent` that contains `target` to the text, as ".key" or "[index]", and returns it. */
static const OstYamlNode *step_down(const OstYaml *yaml, const OstYamlNode *parent, const OstYamlNode *target,
                                    char *text, size_t size)
{
    const OstYamlNode *child = parent + 1;
    const OstYamlNode *key = NULL;
    for (int i = 0; &yaml->node[child->next] <= target; i++) {
        key = i % 2 == 0 ? child : NULL;
        child = &yaml->node[child->next];
        if (parent->kind == OST_YAML_SEQUENCE && &yaml->node[child->next] > target)
            ost_append(text, size, "[%d]", i + 1);
    }
    if (parent->kind == OST_YAML_SEQUENCE && child == parent + 1)
        ost_append(text, size, "[0]");
    if (parent->kind == OST_YAML_MAPPING && key && key->kind == OST_YAML_SCALAR)
        ost_append(text, size, "%s%.40s", text[0] ? "." : "", yaml->text + key->value);
    return child;
}

const char *ost_yaml_place(const OstYaml *yaml, const OstYamlNode *node, char *text, size_t size)
{
    text[0] = 0;
    for (const OstYamlNode *at = yaml->node; at < node;)
        at = step_down(yaml, at, node, text, size);
    if (text[0] == 0)
        ost_append(text, size, "the case");
    return text;
}

void ost_yaml_name_list(const char *const *names, int count, char *text, size_t size)
{
    text[0] = 0;
    for (int i = 0; i < count; i++)
        ost_append(text, size, "%s%s", i > 0 ? ", " : "", names[i]);
}

static void describe(const OstYaml *yaml, const OstYamlNode *node, char *text, size_t size)
{
    const OstYamlNode *value = ost_yaml_follow(yaml, node);
    const char *word = value->kind == OST_YAML_SCALAR ? yaml->text + value->value : "";
    if (value->kind == OST_YAML_MAPPING)
        snprintf(text, size, "a mapping");
    else if (value->kind == OST_YAML_SEQUENCE)
        snprintf(text, size, "a list of %u", (unsigned)value->value);
    else
        snprintf(text, size, "%s'%.*s%s'", value->quoted ? "the quoted text " : "", WORD_SIZE, word,
                 strlen(word) > WORD_SIZE ? "..." : "");
}

OstStatus ost_yaml_raise_type(const OstYaml *yaml, const OstYamlNode *node, const char *expected, const char *more)
{
    char place[OST_YAML_PLACE_SIZE];
    char found[WORD_SIZE + 64];
    ost_yaml_place(yaml, node, place, sizeof place);
    describe(yaml, node, found, sizeof found);
    return ost_yaml_raise(yaml, node, "%s: found %s, expected %s%s%s", place, found, expected,
                          more[0] && more[0] != ' ' ? " " : "", more);
}

/* Levenshtein's distance of two short words, in which swapped neighbours count once. */
static int edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 32 };
    int table[LONGEST + 1][LONGEST + 1];
    const int m = (int)strlen(a);
    const int n = (int)strlen(b);
    if (m > LONGEST || n > LONGEST)
        return LONGEST;
    for (int i = 0; i <= m; i++)
        for (int j = 0; j <= n; j++) {
            if (i == 0 || j == 0) {
                table[i][j] = i + j;
                continue;
            }
            int best = table[i - 1][j - 1] + (tolower((unsigned char)a[i - 1]) != tolower((unsigned char)b[j - 1]));
            best = table[i - 1][j] + 1 < best ? table[i - 1][j] + 1 : best;
            best = table[i][j - 1] + 1 < best ? table[i][j - 1] + 1 : best;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && table[i - 2][j - 2] + 1 < best)
                best = table[i - 2][j - 2] + 1;
            table[i][j] = best;
        }
    return table[m][n];
}

/* Do both begin with the same three quarters of the word, or more? */
static int begins_alike(const char *word, const char *other)
{
    size_t alike = 0;
    while (word[alike] && word[alike] == other[alike])
        alike++;
    return alike >= 4 && 4 * alike >= 3 * strlen(word);
}

/* Is it a part of the other, as force is of total_force? */
static int is_part(const char *word, const char *other)
{
    return strlen(word) >= 4 && strstr(other, word) != NULL;
}

const char *ost_nearest_word(const char *word, const char *const *words, int count)
{
    const char *nearest = NULL;
    int best = 1 + (int)strlen(word) / 3; /* a larger distance is another word */
    for (int w = 0; w < count; w++) {
        const int distance = edit_distance(word, words[w]);
        if (distance <= best && (!nearest || distance < best)) {
            best = distance;
            nearest = words[w];
        }
    }
    for (int w = 0; w < count && !nearest; w++)
        if (begins_alike(word, words[w]))
            nearest = words[w];
    for (int w = 0; w < count && !nearest; w++)
        if (is_part(word, words[w]) || is_part(words[w], word))
            nearest = words[w];
    return nearest;
}
