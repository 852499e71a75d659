// Makes a system call fail as on a bad disk; for LD_PRELOAD. `bad_disk.py` builds and drives it.
//
// BAD_DISK_BELOW  the directory whose files are on that disk, absolute and without links
// BAD_DISK_FAULT  EIO, EINTR: one call fails; ENOSPC: a write and all later ones; ENOLCK: a lock and all
//                 later ones; SHORT: one write writes half; KILL: the process is killed before the call;
//                 POWER: so is each process that makes a later call; PAUSE: one call waits for `goes_on`
// BAD_DISK_AT     number of the call, counted from 1 over all calls that have the fault in all processes
// BAD_DISK_COUNT  `struct counts`, a file that the processes share
// BAD_DISK_KEPT   with POWER, the directory of what survives: at each sync of a file its content, INODE, and
//                 at each sync of a directory its entries, INODE.names; INODE.held keeps the number in use
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

enum { WRITE = 1, LOCK = 2, OTHER = 4, SIZED = 8, READ = 16 };
enum { ONCE, FROM_NOW_ON, HALF, KILL, POWER, PAUSE };

static const struct {
    const char *name;
    int code, calls, effect;
} faults[] = {
    {"EIO", EIO, READ | WRITE | LOCK | OTHER, ONCE},
    {"EINTR", EINTR, WRITE | LOCK | OTHER, ONCE},
    {"ENOSPC", ENOSPC, WRITE, FROM_NOW_ON},
    {"ENOLCK", ENOLCK, LOCK, FROM_NOW_ON},
    {"SHORT", 0, SIZED, HALF},
    {"KILL", 0, WRITE | LOCK | OTHER, KILL},
    {"POWER", 0, WRITE | LOCK | OTHER, POWER},
    {"PAUSE", 0, WRITE | LOCK | OTHER, PAUSE},
};

struct counts {
    unsigned long calls, failed, goes_on;
};

static struct counts *shared(void) {
    static struct counts *counts;
    if (!counts) {
        int file = open(getenv("BAD_DISK_COUNT"), O_RDWR);
        counts = mmap(NULL, sizeof *counts, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        close(file);
    }
    return counts;
}

// Return whether a call of this kind fails, with its errno; halve the size that it writes if it is short.
static int fails(const char *path, int kind, size_t *size) {
    const char *below = getenv("BAD_DISK_BELOW"), *fault = getenv("BAD_DISK_FAULT");
    char absolute[2 * PATH_MAX] = "";
    if (!below || !fault || !path) return 0;
    if (path[0] != '/' && getcwd(absolute, PATH_MAX)) strcat(absolute, "/");
    strncat(absolute, path, PATH_MAX - 1);
    strcat(absolute, "/");
    if (strncmp(absolute, below, strlen(below))) return 0;
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        int has_fault = faults[i].calls & (kind | (size && *size > 1 ? SIZED : 0));
        if (!has_fault || strcmp(faults[i].name, fault)) continue;
        unsigned long at = strtoul(getenv("BAD_DISK_AT"), NULL, 10);
        unsigned long call = __atomic_add_fetch(&shared()->calls, 1, __ATOMIC_SEQ_CST);
        int effect = faults[i].effect;
        if (call < at || (call > at && effect != FROM_NOW_ON && effect != POWER)) return 0;
        __atomic_add_fetch(&shared()->failed, 1, __ATOMIC_SEQ_CST);
        if (effect == KILL || effect == POWER) kill(getpid(), SIGKILL);
        while (effect == PAUSE && !__atomic_load_n(&shared()->goes_on, __ATOMIC_SEQ_CST)) usleep(100);
        if (effect == HALF) *size /= 2;
        errno = faults[i].code;
        return faults[i].code != 0;
    }
    return 0;
}

static int fails_at(int file, int kind, size_t *size) {
    char link[64], path[PATH_MAX];
    snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    ssize_t length = readlink(link, path, sizeof path - 1);
    path[length < 0 ? 0 : length] = 0;
    return fails(path, kind, size);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

// With POWER, keep the content of a file or the entries of a directory: they are on the disk from now on.
static int keep(int file) {
    char kept[PATH_MAX], from[64];
    struct stat status;
    const char *directory = getenv("BAD_DISK_KEPT");
    if (!directory || fstat(file, &status)) return 0;
    snprintf(from, sizeof from, "/proc/self/fd/%d", file);
    int length = snprintf(kept, sizeof kept, "%s/%lu", directory, (unsigned long)status.st_ino);
    if (S_ISDIR(status.st_mode)) {
        strcpy(kept + length, ".names");
        FILE *names = REAL(fopen)(kept, "w");
        DIR *entries = opendir(from);
        for (struct dirent *entry; (entry = readdir(entries));)
            fprintf(names, "%ld %d %s\n", (long)entry->d_ino, entry->d_type == DT_DIR, entry->d_name);
        closedir(entries);
        fclose(names);
        return 0;
    }
    int to = REAL(open)(kept, O_WRONLY | O_CREAT | O_TRUNC, 0666), again = REAL(open)(from, O_RDONLY);
    while (REAL(sendfile64)(to, again, NULL, 1 << 30) > 0) {}
    futimens(to, (struct timespec[]){status.st_atim, status.st_mtim});
    close(again);
    close(to);
    strcpy(kept + length, ".held");
    linkat(AT_FDCWD, from, AT_FDCWD, kept, AT_SYMLINK_FOLLOW);
    return 0;
}

static int keep_at(const char *path, const struct stat *status, int type, struct FTW *at) {
    int file = REAL(open)(path, O_RDONLY);
    (void)status, (void)type, (void)at;
    keep(file);
    close(file);
    return 0;
}

// The machine does not fail, so nothing is really synced.
void sync(void) {
    if (getenv("BAD_DISK_KEPT")) nftw(getenv("BAD_DISK_BELOW"), keep_at, 8, FTW_PHYS);
}

#define OPEN(name, before, ...)                                                   \
    int name(before const char *path, int flags, ...) {                           \
        va_list more;                                                             \
        va_start(more, flags);                                                    \
        mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(more, mode_t) : 0;   \
        va_end(more);                                                             \
        if (fails(path, flags & O_CREAT ? WRITE : OTHER, NULL)) return -1;        \
        return REAL(name)(__VA_ARGS__ path, flags, mode);                         \
    }
#define COMMA ,
OPEN(open, )
OPEN(open64, )
OPEN(openat, int at COMMA, at COMMA)
OPEN(openat64, int at COMMA, at COMMA)

#define FCNTL(name)                                                                               \
    int name(int file, int command, ...) {                                                        \
        va_list more;                                                                             \
        va_start(more, command);                                                                  \
        void *argument = va_arg(more, void *);                                                    \
        va_end(more);                                                                             \
        int locks = command == F_SETLK || command == F_SETLKW;                                    \
        return locks && fails_at(file, LOCK, NULL) ? -1 : REAL(name)(file, command, argument);    \
    }
FCNTL(fcntl)
FCNTL(fcntl64)

// Files of stdio write through calls of this file, too: libc's own calls do not.
static ssize_t write_of_stdio(void *file, const char *from, size_t size) {
    size_t done = 0;
    for (ssize_t written; done < size; done += written) {
        written = write((int)(intptr_t)file, from + done, size - done);
        if (written <= 0) break;
    }
    return done;
}

static int close_of_stdio(void *file) { return close((int)(intptr_t)file); }

#define FOPEN(name)                                                                               \
    FILE *name(const char *path, const char *mode) {                                              \
        if (mode[0] != 'w') return REAL(name)(path, mode);                                        \
        int file = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);                    \
        cookie_io_functions_t calls = {.write = write_of_stdio, .close = close_of_stdio};         \
        return file < 0 ? NULL : fopencookie((void *)(intptr_t)file, mode, calls);                \
    }
FOPEN(fopen)
FOPEN(fopen64)

#define CALL(type, name, test, parameters, ...) \
    type name parameters { return test ? -1 : REAL(name)(__VA_ARGS__); }
#define WRITES(file) fails_at(file, WRITE, &size)
#define READS(file) fails_at(file, READ, NULL)
#define SYNCS(file) fails_at(file, WRITE, NULL)
typedef const void *Data;
CALL(ssize_t, write, WRITES(file), (int file, Data from, size_t size), file, from, size)
CALL(ssize_t, pwrite, WRITES(file), (int file, Data from, size_t size, off_t at), file, from, size, at)
CALL(ssize_t, pwrite64, WRITES(file), (int file, Data from, size_t size, off64_t at), file, from, size, at)
CALL(ssize_t, read, READS(file), (int file, void *to, size_t size), file, to, size)
CALL(ssize_t, pread, READS(file), (int file, void *to, size_t size, off_t at), file, to, size, at)
CALL(ssize_t, pread64, READS(file), (int file, void *to, size_t size, off64_t at), file, to, size, at)
CALL(ssize_t, sendfile64, WRITES(to), (int to, int from, off64_t *at, size_t size), to, from, at, size)
int fsync(int file) { return SYNCS(file) ? -1 : keep(file); }
int fdatasync(int file) { return fsync(file); }
CALL(int, rename, fails(to, OTHER, NULL), (const char *from, const char *to), from, to)
CALL(int, unlink, fails(path, OTHER, NULL), (const char *path), path)
