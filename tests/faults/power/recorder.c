/* Preloaded under a program, appends to the file RECORD_LOG what it does below the folder RECORD_FOLDER, in order.

   A record: kind, path and second path (each with its length), offset, data (with its length). Kinds: [c]reated,
   [w]ritten at an offset, [t]runcated to an offset, [s]ynced, [l]inked, [r]enamed, [u]nlinked. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

static pthread_mutex_t order = PTHREAD_MUTEX_INITIALIZER;
static const char *folder;
static int log_file = -1;

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

__attribute__((constructor)) static void start(void)
{
    const char *path = getenv("RECORD_LOG");
    folder = getenv("RECORD_FOLDER");
    if (path && folder)
        log_file = REAL(open)(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
}

static int recorded(const char *path)
{
    size_t length = folder ? strlen(folder) : 0;
    return log_file >= 0 && path && !strncmp(path, folder, length) && (path[length] == '/' || !path[length]);
}

/* The path under which a descriptor was opened; empty where it is none of the folder's. */
static const char *path_of(int descriptor, char *path)
{
    char link[40];
    snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    ssize_t length = log_file < 0 ? 0 : readlink(link, path, PATH_MAX - 1);
    path[length < 0 ? 0 : length] = 0;
    return recorded(path) ? path : "";
}

static void record(char kind, const char *path, const char *other, int64_t offset, const void *data, size_t length)
{
    uint32_t lengths[] = {(uint32_t)strlen(path), (uint32_t)strlen(other)};
    uint64_t size = length;
    struct iovec parts[] = {
        {&kind, 1}, {lengths, sizeof lengths}, {&offset, sizeof offset}, {&size, sizeof size},
        {(void *)path, lengths[0]}, {(void *)other, lengths[1]}, {(void *)data, length},
    };
    if (writev(log_file, parts, 7) < 0)
        abort();
}

/* Calls are recorded in the order in which they are made; one that fails is not. */
#define RECORDED(call, kind, path, other, offset, data, length)                                                        \
    do {                                                                                                               \
        if (!recorded(path))                                                                                           \
            return call;                                                                                               \
        pthread_mutex_lock(&order);                                                                                    \
        __typeof__(call) result = call;                                                                                \
        if (result >= 0)                                                                                               \
            record(kind, path, other, offset, data, length);                                                           \
        pthread_mutex_unlock(&order);                                                                                  \
        return result;                                                                                                 \
    } while (0)

#define OPEN(name)                                                                                                     \
    int name(const char *path, int flags, ...)                                                                         \
    {                                                                                                                  \
        va_list more;                                                                                                  \
        va_start(more, flags);                                                                                         \
        mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;                                                      \
        va_end(more);                                                                                                  \
        if (!(flags & O_TRUNC) && (!(flags & O_CREAT) || !access(path, F_OK)))                                         \
            return REAL(name)(path, flags, mode);                                                                      \
        RECORDED(REAL(name)(path, flags, mode), 'c', path, "", 0, "", 0);                                              \
    }
OPEN(open)
OPEN(open64)

#define WRITE(name, type)                                                                                              \
    ssize_t name(int descriptor, const void *data, size_t size, type offset)                                           \
    {                                                                                                                  \
        char path[PATH_MAX];                                                                                           \
        RECORDED(REAL(name)(descriptor, data, size, offset), 'w', path_of(descriptor, path), "", offset, data,         \
                 (size_t)result);                                                                                      \
    }
WRITE(pwrite, off_t)
WRITE(pwrite64, off64_t)

ssize_t write(int descriptor, const void *data, size_t size)
{
    char path[PATH_MAX];
    RECORDED(REAL(write)(descriptor, data, size), 'w', path_of(descriptor, path), "",
             lseek(descriptor, 0, SEEK_CUR) - result, data, (size_t)result);
}

#define TRUNCATE(name, type)                                                                                           \
    int name(int descriptor, type size)                                                                                \
    {                                                                                                                  \
        char path[PATH_MAX];                                                                                           \
        RECORDED(REAL(name)(descriptor, size), 't', path_of(descriptor, path), "", size, "", 0);                       \
    }
TRUNCATE(ftruncate, off_t)
TRUNCATE(ftruncate64, off64_t)

#define SYNC(name)                                                                                                     \
    int name(int descriptor)                                                                                           \
    {                                                                                                                  \
        char path[PATH_MAX];                                                                                           \
        RECORDED(REAL(name)(descriptor), 's', path_of(descriptor, path), "", 0, "", 0);                                \
    }
SYNC(fsync)
SYNC(fdatasync)

int link(const char *path, const char *other) { RECORDED(REAL(link)(path, other), 'l', path, other, 0, "", 0); }
int rename(const char *path, const char *other) { RECORDED(REAL(rename)(path, other), 'r', path, other, 0, "", 0); }
int unlink(const char *path) { RECORDED(REAL(unlink)(path), 'u', path, "", 0, "", 0); }
