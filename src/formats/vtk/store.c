/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/vtk/lz4.h"
#include "formats/vtk/xml.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

/* The numbers of a .vtu file: text; bytes in base64 between the tags or appended; or bytes appended as they are. Bytes
 * come after their count, or, compressed, after the counts of blocks: how many, of what size, the size of the last, and
 * what each takes compressed. */

/* zlib packs equal numbers, such as the one region of a body, to no less than a 1032nd. */
enum { LARGEST_RATIO = 1040, LARGEST_BLOCK = 1 << 30 };

typedef struct Bytes {
    const OstVtuStore *store;
    const char *start, *end;
    int base64;
} Bytes;

static int digit_of(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : c == '=' ? 64 : -1;
}

/* Decodes up to `wanted` bytes and returns how many there are. Groups of four digits may be padded anywhere: a header
 * is often encoded apart from its data. */
static size_t decode(const Bytes *from, size_t wanted, char *bytes)
{
    size_t done = 0;
    int digits = 0, group[4];
    for (const char *c = from->start; c < from->end && done < wanted; c++) {
        const int digit = digit_of(*c);
        if (digit < 0 && strchr(" \t\r\n", *c) && *c)
            continue;
        if (digit < 0)
            break;
        group[digits++] = digit;
        if (digits < 4)
            continue;
        digits = 0;
        const unsigned bits = (unsigned)(group[0] & 63) << 18 | (unsigned)(group[1] & 63) << 12 |
                              (unsigned)(group[2] & 63) << 6 | (unsigned)(group[3] & 63);
        const int whole = group[2] == 64 ? 1 : group[3] == 64 ? 2 : 3;
        for (int i = 0; i < whole && done < wanted; i++)
            bytes[done++] = (char)(bits >> (16 - 8 * i) & 255U);
    }
    return done;
}

/* The first `wanted` bytes; room is checked against what the file can hold. */
static OstStatus get(const Bytes *from, OstGlobal wanted, char **bytes)
{
    OstMshCursor *cursor = from->store->cursor;
    size_t found = 0;
    *bytes = NULL;
    if (wanted < 0 || wanted > from->end - from->start)
        return OST_RAISE_MSH(cursor, "%" PRId64 " bytes stated, which do not fit into the file", wanted);
    OST_TRY(OST_NEW(cursor->ctx, bytes, wanted));
    found = (size_t)wanted;
    if (from->base64)
        found = decode(from, (size_t)wanted, *bytes);
    else
        memcpy(*bytes, from->start, found);
    if (found == (size_t)wanted)
        return OST_SUCCESS;
    OST_FREE(*bytes);
    return OST_RAISE_MSH(cursor, "%zu bytes found of %" PRId64 "; the file is incomplete or damaged, write it again",
                         found, wanted);
}

/* The first numbers of a header. */
static OstStatus get_header(const Bytes *from, OstGlobal count, OstGlobal *numbers)
{
    const OstVtuStore *store = from->store;
    const OstVtkType type = {OST_VTK_UNSIGNED, store->header_bytes};
    char *bytes = NULL;
    OST_TRY(get(from, count * store->header_bytes, &bytes));
    for (OstGlobal i = 0; i < count; i++) {
        const double number = ost_vtk_number(type, store->swapped, bytes + i * store->header_bytes);
        numbers[i] = number < (double)OST_LARGEST_LABEL ? (OstGlobal)number : -1;
    }
    OST_FREE(bytes);
    return OST_SUCCESS;
}

static OstStatus get_plain(const Bytes *from, OstGlobal *length, char **data)
{
    OstGlobal count = 0;
    char *bytes = NULL;
    const int header = from->store->header_bytes;
    OST_TRY(get_header(from, 1, &count));
    if (count < 0 || count > from->end - from->start)
        return OST_RAISE_MSH(from->store->cursor, "%" PRId64 " bytes stated, which do not fit into the file", count);
    OST_TRY(get(from, header + count, &bytes));
    memmove(bytes, bytes + header, (size_t)count);
    *length = count;
    *data = bytes;
    return OST_SUCCESS;
}

static int unpack_block(OstVtuPacker packer, const unsigned char *packed, OstGlobal packed_size, unsigned char *data,
                        OstGlobal size)
{
    uLongf written = (uLongf)size;
    if (packer == OST_VTU_LZ4)
        return ost_lz4_unpack(packed, (size_t)packed_size, data, (size_t)size);
    return uncompress(data, &written, packed, (uLong)packed_size) == Z_OK && (OstGlobal)written == size;
}

/* Unpacks the blocks, whose packed bytes follow the header of 3 + blocks numbers. */
static OstStatus unpack(const Bytes *from, const OstGlobal *header, const char *packed, char *data)
{
    const OstGlobal blocks = header[0], last = header[2];
    OstGlobal at = 0, done = 0;
    for (OstGlobal b = 0; b < blocks; b++) {
        const OstGlobal size = b + 1 == blocks && last > 0 ? last : header[1];
        if (!unpack_block(from->store->packer, (const unsigned char *)packed + at, header[3 + b],
                          (unsigned char *)data + done, size))
            return OST_RAISE_MSH(from->store->cursor,
                                 "block %" PRId64 " cannot be unpacked; the file is damaged, write it "
                                 "again",
                                 b + 1);
        at += header[3 + b];
        done += size;
    }
    return OST_SUCCESS;
}

static OstStatus check_blocks(const Bytes *from, const OstGlobal *header, OstGlobal *packed, OstGlobal *length)
{
    OstMshCursor *cursor = from->store->cursor;
    const OstGlobal room = from->end - from->start, blocks = header[0];
    *packed = 0;
    if (header[1] < 0 || header[1] > LARGEST_BLOCK || header[2] < 0 || header[2] > LARGEST_BLOCK)
        return OST_RAISE_MSH(cursor, "blocks of %" PRId64 " bytes; the file is damaged, write it again", header[1]);
    for (OstGlobal b = 0; b < blocks; b++) {
        if (header[3 + b] < 0 || header[3 + b] > room - *packed)
            return OST_RAISE_MSH(cursor, "block %" PRId64 " does not fit into the file", b + 1);
        if ((b + 1 == blocks && header[2] > 0 ? header[2] : header[1]) / LARGEST_RATIO > header[3 + b])
            return OST_RAISE_MSH(cursor,
                                 "block %" PRId64 " is said to unpack to more than zlib packs; the file is damaged, "
                                 "write it again",
                                 b + 1);
        *packed += header[3 + b];
    }
    *length = blocks > 0 ? (blocks - 1) * header[1] + (header[2] > 0 ? header[2] : header[1]) : 0;
    return OST_SUCCESS;
}

static OstStatus get_compressed(const Bytes *from, OstGlobal *length, char **data)
{
    OstContext *ctx = from->store->cursor->ctx;
    const int bytes_each = from->store->header_bytes;
    OstGlobal blocks = 0, packed_bytes = 0, *header = NULL;
    char *packed = NULL;
    OstStatus status = OST_SUCCESS;
    *data = NULL;
    OST_TRY(get_header(from, 1, &blocks));
    if (blocks < 0 || blocks > (from->end - from->start) / bytes_each)
        return OST_RAISE_MSH(from->store->cursor, "%" PRId64 " blocks stated, which do not fit into the file", blocks);
    OST_TRY_DONE(OST_NEW(ctx, &header, 3 + blocks));
    if (blocks > 0)
        OST_TRY_DONE(get_header(from, 3 + blocks, header));
    OST_TRY_DONE(check_blocks(from, header, &packed_bytes, length));
    OST_TRY_DONE(get(from, (3 + blocks) * bytes_each + packed_bytes, &packed));
    OST_TRY_DONE(OST_NEW(ctx, data, *length));
    status = unpack(from, header, packed + (3 + blocks) * bytes_each, *data);
done:
    OST_FREE(header, packed);
    if (status != OST_SUCCESS)
        OST_FREE(*data);
    return status;
}

/* --- numbers --- */

static OstStatus read_type(OstMshCursor *cursor, const OstXmlTag *tag, OstVtkType *type)
{
    static const struct {
        const char *word;
        OstVtkType type;
    } types[] = {
        {"Float64", {OST_VTK_FLOAT, 8}},   {"Float32", {OST_VTK_FLOAT, 4}},   {"Int64", {OST_VTK_SIGNED, 8}},
        {"Int32", {OST_VTK_SIGNED, 4}},    {"UInt8", {OST_VTK_UNSIGNED, 1}},  {"Int8", {OST_VTK_SIGNED, 1}},
        {"UInt32", {OST_VTK_UNSIGNED, 4}}, {"UInt64", {OST_VTK_UNSIGNED, 8}}, {"Int16", {OST_VTK_SIGNED, 2}},
        {"UInt16", {OST_VTK_UNSIGNED, 2}},
    };
    const char *word = ost_xml_value(tag, "type");
    for (size_t t = 0; word && t < sizeof types / sizeof *types; t++)
        if (strcasecmp(word, types[t].word) == 0) {
            *type = types[t].type;
            return OST_SUCCESS;
        }
    return OST_RAISE_MSH(cursor, "an array of the type '%s', expected one of numbers such as Float64",
                         word ? word : "");
}

static OstStatus from_bytes(const Bytes *from, OstVtkType type, OstGlobal *count, double **values)
{
    OstMshCursor *cursor = from->store->cursor;
    OstGlobal length = 0;
    char *data = NULL;
    if (from->store->packer == OST_VTU_OTHER)
        return OST_RAISE_MSH(cursor, "data packed by neither zlib nor LZ4; write the file again so (in ParaView's Save "
                                     "Data, Compressor Type: ZLib)");
    OST_TRY(from->store->packer != OST_VTU_PLAIN ? get_compressed(from, &length, &data)
                                                 : get_plain(from, &length, &data));
    const OstGlobal found = length / type.bytes;
    OstStatus status = OST_SUCCESS;
    if (*count >= 0 && found != *count)
        status = OST_RAISE_MSH(cursor, "%" PRId64 " numbers found, expected %" PRId64, found, *count);
    *count = found;
    OST_THEN(OST_NEW(cursor->ctx, values, found));
    for (OstGlobal i = 0; i < found && status == OST_SUCCESS; i++)
        (*values)[i] = ost_vtk_number(type, from->store->swapped, data + i * type.bytes);
    OST_FREE(data);
    return status;
}

/* Numbers between blanks, up to the next tag. */
static OstStatus from_text(OstMshCursor *cursor, OstGlobal *count, double **values)
{
    OstGlobal found = 0;
    OST_TRY(OST_NEW(cursor->ctx, values, 64));
    for (const char *at = cursor->next;;) {
        char *end = NULL;
        while (at < cursor->end && strchr(" \t\r\n", *at) && *at)
            at++;
        if (at >= cursor->end || *at == '<')
            break;
        cursor->place = at;
        const double value = strtod(at, &end);
        if (end == at || (*end != '<' && (*end == '\0' || !strchr(" \t\r\n", *end))))
            return OST_RAISE_MSH(cursor, "'%.*s' found, expected a number", (int)strcspn(at, " \t\r\n<") & 63, at);
        OST_TRY(OST_GROW(cursor->ctx, values, found + 1));
        (*values)[found++] = value;
        at = end;
    }
    if (*count >= 0 && found != *count)
        return OST_RAISE_MSH(cursor, "%" PRId64 " numbers found, expected %" PRId64, found, *count);
    *count = found;
    return OST_SUCCESS;
}

OstStatus ost_vtu_numbers(const OstVtuStore *store, const OstXmlTag *tag, OstGlobal *count, double **values)
{
    OstMshCursor *cursor = store->cursor;
    const char *format = ost_xml_value(tag, "format");
    OstVtkType type;
    OstGlobal offset = 0;
    *values = NULL;
    OST_TRY(read_type(cursor, tag, &type));
    if (!format || strcmp(format, "ascii") == 0)
        return from_text(cursor, count, values);
    Bytes from = {store, cursor->next, cursor->end, 1};
    if (strcmp(format, "appended") == 0) {
        OST_TRY(ost_xml_number(cursor, tag, "offset", 0, &offset));
        if (!store->appended || offset > cursor->end - store->appended)
            return OST_RAISE_MSH(cursor, "data are said to be appended at %" PRId64 ", beyond the end of the file",
                                 offset);
        from = (Bytes){store, store->appended + offset, cursor->end, store->base64};
    } else if (strcmp(format, "binary") != 0) {
        return OST_RAISE_MSH(cursor, "the format '%s' found, expected ascii, binary or appended", format);
    }
    return from_bytes(&from, type, count, values);
}
