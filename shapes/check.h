/* check.h - a broken promise of a caller stops the program with file and line, in release too. */
#ifndef CLAST_SHAPES_CHECK_H
#define CLAST_SHAPES_CHECK_H

_Noreturn void shape_panic(const char *file, int line, const char *what);

#define SHAPE_ASSERT(cond) ((cond) ? (void)0 : shape_panic(__FILE__, __LINE__, #cond))

#endif
