/* hdf5_io.h - the only door to HDF5: arrays, texts and attributes in files that appear whole or
 * not.
 *
 *     h5_file *f = h5_create("bed.h5");
 *     h5_write(f, "/body/mass", H5_F64, 1, (size_t[]){n}, mass);
 *     h5_attribute_double(f, "/", "time", t);
 *     if (h5_publish(f) != CLAST_OK) puts(h5_error(f));
 *     h5_free(f);
 *
 * A new file is written as "<path>.tmp"; publishing flushes it to the disk and renames it, so
 * whoever looks at <path> finds the old file or the whole new one. Errors stick: after the first
 * failure every call does nothing (reads give zeros), and h5_status() and h5_error() tell about
 * that first failure. So a caller writes everything and looks once. Use one thread at a time.
 */
#ifndef CLAST_HDF5_IO_H
#define CLAST_HDF5_IO_H

#include <stdarg.h>

#include "engine/clast.h"

typedef struct h5_file h5_file;

typedef enum h5_type { H5_F64, H5_F32, H5_I32, H5_U32, H5_U64, H5_U8 } h5_type;

enum { H5_RANK_MAX = 4, H5_ERROR_MAX = 1024 };

/* Never NULL: a file that could not be opened carries its error. */
h5_file *h5_create(const char *path);
h5_file *h5_open(const char *path); /* for reading */
/* To which nothing is written, with success: of a process that leaves writing to another. */
h5_file *h5_create_mute(const char *path);

clast_status h5_status(const h5_file *f);
const char *h5_error(const h5_file *f); /* "" while all is well */

/* Lets a reader add a failure of its own ("bodies and shapes differ in length"). */
void h5_fail(h5_file *f, clast_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* On any failure the temporary file is removed and the old file stays as it was. */
clast_status h5_publish(h5_file *f);

/* Closes; throws a new file away that was not published. NULL is fine. */
void h5_free(h5_file *f);

/* Groups on the way are made as needed, also by the writes below. */
void h5_group(h5_file *f, const char *name);
bool h5_has(h5_file *f, const char *name);

/* The name of the index-th member of a group in the order of names, malloc'ed; NULL when there are
 * no more. */
char *h5_member(h5_file *f, const char *group, size_t index);

/* Large arrays are cut into chunks, shuffled and deflated. */
void h5_write(h5_file *f, const char *name, h5_type type, int rank, const size_t *extent,
              const void *data);
void h5_write_column(h5_file *f, const char *name, h5_type type, size_t count, const void *data);
void h5_write_text(h5_file *f, const char *name, const char *text);

/* Rank of a dataset and its extents; a missing dataset is a failure. */
int h5_extent(h5_file *f, const char *name, size_t extent[H5_RANK_MAX]);
size_t h5_count(h5_file *f, const char *name); /* number of elements, all dimensions */

/* Reads a whole dataset of exactly `count` elements, converting the number type. */
void h5_read(h5_file *f, const char *name, h5_type type, size_t count, void *data);

/* The same into malloc'ed memory, at least one element long. */
void *h5_read_all(h5_file *f, const char *name, h5_type type, size_t *count);
char *h5_read_text(h5_file *f, const char *name);

void h5_attribute_text(h5_file *f, const char *object, const char *name, const char *text);
void h5_attribute_double(h5_file *f, const char *object, const char *name, double value);
void h5_attribute_u64(h5_file *f, const char *object, const char *name, uint64_t value);
char *h5_text_attribute(h5_file *f, const char *object, const char *name);
double h5_double_attribute(h5_file *f, const char *object, const char *name);
uint64_t h5_u64_attribute(h5_file *f, const char *object, const char *name);

/* Copies an object with all that is in it. */
void h5_copy(h5_file *from, const char *name, h5_file *to, const char *new_name);

/* "1.10.8" */
const char *h5_library_version(void);

#endif
