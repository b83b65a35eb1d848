#include "resources.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined _WIN32
#include <windows.h>
#endif

static const char NAME[] = "/numbers.bin", MAGIC[] = "RIDELAB1";
static const long MOST_BYTES = 1L << 28;
enum { MAGIC_BYTES = 8, HEAD_BYTES = 16 };

static int digit(char text)
{
    return text >= '0' && text <= '9' ? text - '0' : (text | 32) >= 'a' && (text | 32) <= 'f' ? (text | 32) - 'a' + 10 : -1;
}

/* Where the path begins in a file's address (RFC 8089); a host other than this one stays, as Windows has it. */
static const char *path_of(const char *address)
{
    const char *path = address + strlen("file:");
    if (strncmp(path, "//", 2) == 0) {
        const char *slash = strchr(path + 2, '/');
        int here = slash == path + 2 || strncmp(path + 2, "localhost/", 10) == 0;
        path = here ? slash : path;
    }
#if defined _WIN32
    size_t slashes = strspn(path, "/");
    if (slashes && path[slashes] && path[slashes + 1] == ':') /* a drive */
        path += slashes;
#endif
    return path;
}

/* The path of numbers.bin, to be freed. */
static char *file_path(const char *resources)
{
    int address = strncmp(resources, "file:", 5) == 0;
    const char *from = address ? path_of(resources) : resources;
    char *path = malloc(strlen(from) + sizeof NAME), *to = path;
    if (!path)
        return NULL;
    for (; *from; from++)
        if (address && *from == '%' && digit(from[1]) >= 0 && digit(from[2]) >= 0) {
            *to++ = (char)(16 * digit(from[1]) + digit(from[2]));
            from += 2;
        } else
            *to++ = *from;
    memcpy(to, NAME, sizeof NAME);
    return path;
}

static FILE *opened(const char *path)
{
#if defined _WIN32
    FILE *file = NULL;
    int length = MultiByteToWideChar(CP_UTF8, 0, path, -1, NULL, 0);
    wchar_t *wide = malloc(sizeof *wide * (size_t)(length > 0 ? length : 1));
    if (wide && length > 0 && MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, length) == length)
        file = _wfopen(wide, L"rb");
    free(wide);
    return file;
#else
    return fopen(path, "rb");
#endif
}

/* All bytes of a file, to be freed, and how many; NULL where it cannot be read. */
static char *content_of(const char *path, size_t *length)
{
    FILE *file = opened(path);
    if (!file)
        return NULL;
    long end = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    char *content = end >= 0 && end <= MOST_BYTES && fseek(file, 0, SEEK_SET) == 0 ? malloc((size_t)end + 1) : NULL;
    if (content && fread(content, 1, (size_t)end, file) != (size_t)end) {
        free(content);
        content = NULL;
    }
    fclose(file);
    *length = (size_t)end;
    return content;
}

static uint32_t word(const char *content)
{
    const unsigned char *byte = (const unsigned char *)content;
    return byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 | (uint32_t)byte[3] << 24;
}

/* CRC-32 (ISO 3309), bit by bit. */
static uint32_t checksum(const char *content, size_t length)
{
    uint32_t rest = ~(uint32_t)0;
    for (size_t i = 0; i < length; i++) {
        rest ^= (unsigned char)content[i];
        for (int bit = 0; bit < 8; bit++)
            rest = rest >> 1 ^ (rest & 1 ? 0xEDB88320u : 0);
    }
    return ~rest;
}

/* Set what the content says; whether it is whole. */
static int understood(struct resources *me, size_t length)
{
    if (length < HEAD_BYTES || memcmp(me->content, MAGIC, MAGIC_BYTES) != 0
        || word(me->content + MAGIC_BYTES) != checksum(me->content + 12, length - 12))
        return 0;
    size_t text = word(me->content + 12);
    if (text == 0 || text % sizeof(double) || text > length - HEAD_BYTES || (length - HEAD_BYTES - text) % sizeof(double))
        return 0;
    me->token = me->content + HEAD_BYTES;
    if (me->token[text - 1] != 0)
        return 0;
    me->numbers = (const double *)(const void *)(me->token + text);
    me->count = (length - HEAD_BYTES - text) / sizeof(double);
    me->names = me->token + strlen(me->token) + 1;
    me->variables = (size_t)ridelab_take_whole(me, 1, 1000000);
    me->causality = ridelab_take(me, me->variables);
    me->whole = ridelab_take(me, me->variables);
    me->start = ridelab_take(me, me->variables);
    for (size_t i = 0; i < me->count; i++)
        if (!isfinite(me->numbers[i]))
            return 0;
    for (size_t i = 0; !me->damaged && i < me->variables; i++)
        if (me->whole[i] != 0 && !(fabs(me->start[i]) <= INT32_MAX))
            return 0;
    size_t names = 0;
    for (const char *at = me->names; at < me->token + text && *at; at += strlen(at) + 1)
        names++;
    return !me->damaged && names == me->variables;
}

const char *ridelab_read(struct resources *me, const char *resources)
{
    char *path = resources && *resources ? file_path(resources) : NULL;
    size_t length = 0;
    memset(me, 0, sizeof *me);
    me->content = path ? content_of(path, &length) : NULL;
    free(path);
    if (!me->content)
        return "numbers.bin cannot be read from the FMU's resources folder";
    return understood(me, length) ? NULL : "numbers.bin in the FMU's resources folder is damaged";
}

void ridelab_forget(struct resources *me)
{
    free(me->content);
    me->content = NULL;
}

size_t ridelab_place(struct resources *me, const char *name, size_t count)
{
    const char *at = me->names;
    for (size_t place = 0; place < me->variables; place++, at += strlen(at) + 1)
        if (strcmp(at, name) == 0 && count <= me->variables - place)
            return place;
    me->damaged = 1;
    return 0;
}

const double *ridelab_take(struct resources *me, size_t count)
{
    if (me->damaged || count > me->count - me->taken) {
        me->damaged = 1;
        return NULL;
    }
    me->taken += count;
    return me->numbers + me->taken - count;
}

int ridelab_take_whole(struct resources *me, int least, int most)
{
    const double *number = ridelab_take(me, 1);
    if (number && *number >= least && *number <= most && *number == (int)*number)
        return (int)*number;
    me->damaged = 1;
    return least;
}

int ridelab_is_whole(const struct resources *me)
{
    return !me->damaged && me->taken == me->count;
}
