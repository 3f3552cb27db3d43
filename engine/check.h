/* check.h - the three tools against three kinds of failure (clast.h says which is which). */
#ifndef CLAST_CHECK_H
#define CLAST_CHECK_H

_Noreturn void clast_panic(const char *file, int line, const char *what);

/* A broken promise stops the program, in release too. */
#define CLAST_ASSERT(cond) ((cond) ? (void)0 : clast_panic(__FILE__, __LINE__, #cond))

/* A costly test, O(n) or inside a hot loop: checked builds only. */
#ifdef CLAST_CHECKED
#define CLAST_CHECK(cond) CLAST_ASSERT(cond)
#else
#define CLAST_CHECK(cond) ((void)0)
#endif

#endif
