/* folder.h - names of the files of a run, and the few things done with folders. */
#ifndef CLAST_RUN_FOLDER_H
#define CLAST_RUN_FOLDER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FILE_RUN        "run.h5"
#define FILE_XDMF       "run.xdmf"
#define FILE_SERIES     "series.csv"
#define FILE_FEEDS      "feeds.csv"
#define FILE_OUTLETS    "outlets.csv"
#define FILE_CHECKPOINT "checkpoint.h5"
#define FILE_FAILED     "failed.h5"
#define FILE_SCENE      "scene.yaml"
#define FOLDER_FRAMES   "frames"

/* printf into malloc'ed memory. */
char *text_format(const char *format, ...) __attribute__((format(printf, 1, 2)));

char *path_in(const char *folder, const char *name); /* malloc'ed */
bool path_exists(const char *path);

/* Makes a folder with its parents; 0 or errno. */
int folder_make(const char *path);
bool folder_is_empty(const char *path); /* also when there is none */

/* Makes the folder and holds it for one run: two would write into each other's files. A descriptor
 * to close, or -errno; -EWOULDBLOCK: another one holds it. The hold ends with the process, however
 * that ends. Where the file system knows no locks nothing is held. */
int folder_hold(const char *path);

/* Removes what runs write (and nothing else); 0 or errno. */
int folder_clear_run(const char *path);

/* Removes frames of which `drop` says so, and left-over temporary files. */
void folder_drop_parts(const char *path, bool drop(const char *part, void *context), void *context);

/* Numbers of the parts <folder>/frames/NNNNNN.h5 in order; malloc'ed. */
long *folder_parts(const char *folder, size_t *count);
char *folder_part(const char *folder, long number);

/* Writes a whole text through a temporary file; 0 or errno. */
int file_write_text(const char *path, const char *text);

#endif
