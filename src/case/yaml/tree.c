/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/yaml/tree.h"

#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>
#include <string.h>
#include <yaml.h>

_Static_assert(sizeof(OstYamlNode) == 16, "a node must stay small");

typedef struct Anchor {
    char *name;
    uint32_t node;
    uint64_t weight; /* nodes in its value, with aliases counted at the weight of their values; 0 while open */
} Anchor;

typedef struct Level {
    uint32_t node;
    int anchor; /* or -1 */
    uint64_t weight_before;
} Level;

/* State of one pass over the events. The first pass counts and checks, the second fills the tree. */
typedef struct Walk {
    OstYaml *yaml;
    const char *bytes;
    size_t size;
    int filling;
    uint32_t nodes;
    size_t text;
    uint64_t weight, weight_limit;
    int depth;
    Level level[OST_YAML_MAX_DEPTH];
    int anchors;
    Anchor anchor[OST_YAML_MAX_ANCHORS];
} Walk;

static OstStatus raise_at(const Walk *walk, yaml_mark_t mark, const char *problem)
{
    return OST_RAISE(walk->yaml->ctx, OST_INVALID_INPUT, "%s:%zu:%zu: %s", walk->yaml->path, mark.line + 1,
                     mark.column + 1, problem);
}

/* For a byte that is not UTF-8 the parser's mark is imprecise, but its offset is right. */
static yaml_mark_t mark_of_byte(const Walk *walk, size_t offset)
{
    yaml_mark_t mark = {0, 0, 0};
    for (size_t i = 0; i < offset && i < walk->size; i++) {
        const int breaks = walk->bytes[i] == '\n';
        mark.line += (size_t)breaks;
        mark.column = breaks ? 0 : mark.column + ((walk->bytes[i] & 0xc0) != 0x80);
    }
    return mark;
}

static OstStatus raise_syntax(const Walk *walk, const yaml_parser_t *parser)
{
    char problem[512];
    const char *what = parser->problem ? parser->problem : "syntax error";
    if (parser->error == YAML_MEMORY_ERROR)
        return OST_RAISE(walk->yaml->ctx, OST_OUT_OF_MEMORY, "%s: out of memory in the YAML parser", walk->yaml->path);
    if (parser->error == YAML_READER_ERROR) {
        snprintf(problem, sizeof problem, "not text in UTF-8: %s; save the file as UTF-8", what);
        return raise_at(walk, mark_of_byte(walk, parser->problem_offset), problem);
    }
    snprintf(problem, sizeof problem, "not YAML: %s%s%s%s", parser->context ? parser->context : "",
             parser->context ? ", " : "", what,
             strstr(what, "cannot start any token")      ? " (a tab? YAML indents by blanks)"
             : strstr(what, "mapping values are not al") ? " (a colon within a text? put the text between quotes)"
                                                         : "");
    return raise_at(walk, parser->problem_mark, problem);
}

static OstYamlNode *add_node(Walk *walk, OstYamlKind kind, yaml_mark_t mark)
{
    const uint32_t index = walk->nodes++;
    walk->weight++;
    if (walk->depth > 0 && walk->filling)
        walk->yaml->node[walk->level[walk->depth - 1].node].value++;
    if (!walk->filling)
        return NULL;
    OstYamlNode *node = &walk->yaml->node[index];
    node->line = mark.line & 0xffffff;
    node->column = mark.column & 0xffffff;
    node->kind = kind;
    node->next = index + 1;
    return node;
}

/* Remembers an anchor; `index` is -1 if there is none. Only the first pass checks the name. */
static OstStatus add_anchor(Walk *walk, const yaml_char_t *name, yaml_mark_t mark, int *index)
{
    *index = -1;
    if (!name)
        return OST_SUCCESS;
    if (walk->anchors == OST_YAML_MAX_ANCHORS)
        return raise_at(walk, mark, "more than 256 anchors (&name); write the values out");
    Anchor *anchor = &walk->anchor[walk->anchors];
    OST_TRY(ost_copy_string(walk->yaml->ctx, (const char *)name, &anchor->name));
    anchor->node = walk->nodes;
    anchor->weight = 0;
    *index = walk->anchors++;
    return OST_SUCCESS;
}

static OstStatus add_scalar(Walk *walk, const yaml_event_t *event)
{
    int anchor;
    const size_t length = event->data.scalar.length;
    if (memchr(event->data.scalar.value, 0, length))
        return raise_at(walk, event->start_mark, "a zero byte within a text; take it out");
    OST_TRY(add_anchor(walk, event->data.scalar.anchor, event->start_mark, &anchor));
    OstYamlNode *node = add_node(walk, OST_YAML_SCALAR, event->start_mark);
    if (node) {
        node->quoted = event->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
        node->value = (uint32_t)walk->text;
        memcpy(walk->yaml->text + walk->text, event->data.scalar.value, length + 1);
    }
    if (anchor >= 0)
        walk->anchor[anchor].weight = 1;
    walk->text += length + 1;
    return OST_SUCCESS;
}

static OstStatus add_alias(Walk *walk, const yaml_event_t *event)
{
    const char *name = (const char *)event->data.alias.anchor;
    int found = walk->anchors - 1; /* the last anchor of a name counts */
    while (found >= 0 && strcmp(walk->anchor[found].name, name) != 0)
        found--;
    if (found < 0)
        return raise_at(walk, event->start_mark, "an alias (*name) to an anchor (&name) that is not there before it");
    if (walk->anchor[found].weight == 0)
        return raise_at(walk, event->start_mark, "an alias (*name) within the value it stands for");
    OstYamlNode *node = add_node(walk, OST_YAML_ALIAS, event->start_mark);
    if (node)
        node->value = walk->anchor[found].node;
    walk->weight += walk->anchor[found].weight;
    return OST_SUCCESS;
}

static OstStatus open_level(Walk *walk, OstYamlKind kind, const yaml_event_t *event)
{
    const yaml_char_t *name =
        kind == OST_YAML_SEQUENCE ? event->data.sequence_start.anchor : event->data.mapping_start.anchor;
    int anchor;
    if (walk->depth == OST_YAML_MAX_DEPTH)
        return raise_at(walk, event->start_mark, "nested more than 32 deep; no case is");
    OST_TRY(add_anchor(walk, name, event->start_mark, &anchor));
    const Level level = {walk->nodes, anchor, walk->weight};
    add_node(walk, kind, event->start_mark);
    walk->level[walk->depth++] = level;
    return OST_SUCCESS;
}

static void close_level(Walk *walk)
{
    const Level *level = &walk->level[--walk->depth];
    if (level->anchor >= 0)
        walk->anchor[level->anchor].weight = walk->weight - level->weight_before;
    if (!walk->filling)
        return;
    OstYamlNode *node = &walk->yaml->node[level->node];
    node->next = walk->nodes;
    if (node->kind == OST_YAML_MAPPING)
        node->value /= 2;
}

/* A tag would be read past: `!GPa 11` as 11. */
static OstStatus check_tag(const Walk *walk, const yaml_event_t *event)
{
    char text[120];
    const yaml_char_t *tag = event->type == YAML_SCALAR_EVENT           ? event->data.scalar.tag
                             : event->type == YAML_SEQUENCE_START_EVENT ? event->data.sequence_start.tag
                             : event->type == YAML_MAPPING_START_EVENT  ? event->data.mapping_start.tag
                                                                        : NULL;
    if (!tag)
        return OST_SUCCESS;
    snprintf(text, sizeof text, "found the tag '%.60s'; tags have no meaning here, leave it out", (const char *)tag);
    return raise_at(walk, event->start_mark, text);
}

static OstStatus take_event(Walk *walk, const yaml_event_t *event)
{
    OST_TRY(check_tag(walk, event));
    switch (event->type) {
    case YAML_DOCUMENT_START_EVENT:
        return walk->nodes == 0 ? OST_SUCCESS
                                : raise_at(walk, event->start_mark, "a second document; a file holds one case");
    case YAML_SCALAR_EVENT:
        OST_TRY(add_scalar(walk, event));
        break;
    case YAML_ALIAS_EVENT:
        OST_TRY(add_alias(walk, event));
        break;
    case YAML_SEQUENCE_START_EVENT:
        OST_TRY(open_level(walk, OST_YAML_SEQUENCE, event));
        break;
    case YAML_MAPPING_START_EVENT:
        OST_TRY(open_level(walk, OST_YAML_MAPPING, event));
        break;
    case YAML_SEQUENCE_END_EVENT:
    case YAML_MAPPING_END_EVENT:
        close_level(walk);
        break;
    default:
        break;
    }
    if (walk->weight > walk->weight_limit)
        return raise_at(walk, event->start_mark, "more values than a file of this size can state; use fewer aliases");
    return OST_SUCCESS;
}

static OstStatus take_events(Walk *walk, yaml_parser_t *parser)
{
    OstStatus status = OST_SUCCESS;
    for (int ended = 0; !ended && status == OST_SUCCESS;) {
        yaml_event_t event;
        if (!yaml_parser_parse(parser, &event))
            return raise_syntax(walk, parser);
        status = take_event(walk, &event);
        ended = event.type == YAML_STREAM_END_EVENT;
        yaml_event_delete(&event);
    }
    return status;
}

static OstStatus walk_text(Walk *walk)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser))
        return OST_RAISE(walk->yaml->ctx, OST_OUT_OF_MEMORY, "%s: out of memory in the YAML parser", walk->yaml->path);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)walk->bytes, walk->size);
    const OstStatus status = take_events(walk, &parser);
    yaml_parser_delete(&parser);
    for (int a = 0; a < walk->anchors; a++)
        OST_FREE(walk->anchor[a].name);
    walk->anchors = 0;
    return status;
}

static OstStatus measure_and_fill(OstYaml *yaml, const char *bytes, size_t size)
{
    OstContext *ctx = yaml->ctx;
    Walk *walk = NULL;
    OST_TRY(OST_NEW(ctx, &walk, 1));
    OstStatus status = OST_SUCCESS;
    *walk = (Walk){.yaml = yaml, .bytes = bytes, .size = size};
    walk->weight_limit = size / 3 + 10000; /* so that a tree is no more than six times its text */
    OST_TRY_DONE(walk_text(walk));
    if (walk->nodes == 0) {
        status =
            OST_RAISE(ctx, OST_INVALID_INPUT, "%s:1:1: the file is empty; a case needs a mesh at least", yaml->path);
        goto done;
    }
    yaml->count = walk->nodes;
    OST_TRY_DONE(OST_NEW(ctx, &yaml->node, walk->nodes));
    OST_TRY_DONE(OST_NEW(ctx, &yaml->text, walk->text));
    yaml->text_size = walk->text;
    *walk = (Walk){.yaml = yaml, .bytes = bytes, .size = size, .filling = 1, .weight_limit = UINT64_MAX};
    OST_TRY_DONE(walk_text(walk));
done:
    OST_FREE(walk);
    return status;
}

OstStatus ost_yaml_parse(OstContext *ctx, const char *path, const char *bytes, size_t size, OstYaml **yaml)
{
    *yaml = NULL;
    if (size > OST_YAML_MAX_BYTES)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: a case file of %zu bytes; at most %d are read", path, size,
                         OST_YAML_MAX_BYTES);
    OstYaml *made = NULL;
    OST_TRY(OST_NEW(ctx, &made, 1));
    made->ctx = ctx;
    made->path = path;
    const size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    const OstStatus status = measure_and_fill(made, bytes + mark, size - mark);
    if (status != OST_SUCCESS)
        ost_yaml_destroy(&made);
    *yaml = made;
    return status;
}

void ost_yaml_destroy(OstYaml **yaml)
{
    if (!*yaml)
        return;
    OST_FREE((*yaml)->node, (*yaml)->text);
    OST_FREE_EACH((*yaml)->settings, (*yaml)->setting);
    OST_FREE(*yaml);
}

const OstYamlNode *ost_yaml_follow(const OstYaml *yaml, const OstYamlNode *node)
{
    return node->kind == OST_YAML_ALIAS ? &yaml->node[node->value] : node;
}

int ost_yaml_line(const OstYamlNode *node)
{
    return (int)node->line + 1;
}

int ost_yaml_is(const OstYaml *yaml, const OstYamlNode *node, OstYamlKind kind)
{
    return (OstYamlKind)ost_yaml_follow(yaml, node)->kind == kind;
}

const OstYamlNode *ost_yaml_first(const OstYaml *yaml, const OstYamlNode *node)
{
    return ost_yaml_follow(yaml, node) + 1;
}

const OstYamlNode *ost_yaml_next(const OstYaml *yaml, const OstYamlNode *node)
{
    return &yaml->node[node->next];
}

const char *ost_yaml_setting(const OstYaml *yaml, const OstYamlNode *node)
{
    return node->set > 0 ? yaml->setting[node->set - 1] : NULL;
}
