/* pictures.h - frames and films of runs, by the `clast render` command that users have.
 *
 *     picture_still(CLAST_COMMAND, run, 1.5, "build/frames", "half-way", "speed");
 *     picture_movie(CLAST_COMMAND, run, "build/frames", "flow", "speed", "2");
 *
 * Each returns 0, or the exit code of the command, or 4 when a file cannot be written. */
#ifndef CLAST_STUDY_PICTURES_H
#define CLAST_STUDY_PICTURES_H

#include <stddef.h>
#include <stdint.h>

/* The frame of a run that is nearest to a time, as <folder>/<name>.png. */
int picture_still(const char *clast, const char *run, double time, const char *folder,
                  const char *name, const char *colour);

enum { PICTURE_MARKS = 128 };

/* The same with bodies in black, of a list the first PICTURE_MARKS; speed_max as below. */
int picture_marked(const char *clast, const char *run, double time, const char *folder,
                   const char *name, const char *colour, const char *speed_max, const uint32_t *id,
                   int count);

/* All frames as <folder>/<name>/frame-*.png, and <folder>/<name>.mp4 where there is ffmpeg.
 * speed_max: m/s as text, the end of the scale of the colour `speed` in all frames; NULL: that of
 * the run. */
int picture_movie(const char *clast, const char *run, const char *folder, const char *name,
                  const char *colour, const char *speed_max);

/* The same from frame `first` on and with bodies in black, of a list the first PICTURE_MARKS. */
int picture_movie_marked(const char *clast, const char *run, const char *folder, const char *name,
                         const char *colour, const char *speed_max, size_t first,
                         const uint32_t *id, int count);

#endif
