/* guards.h - failures of a shared world against those of a world alone. */
#ifndef CLAST_TESTS_GUARDS_H
#define CLAST_TESTS_GUARDS_H

/* How many differ; the first process says which. */
int faults_of_guards(void);

#endif
