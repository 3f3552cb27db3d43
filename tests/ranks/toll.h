/* toll.h - what messages cost a process: stands between its worlds and the transport. */
#ifndef CLAST_TESTS_TOLL_H
#define CLAST_TESTS_TOLL_H

/* After clast_ranks_begin(), before the first world. */
void toll_begin(void);

/* s of processor time, so far: of this process, and of its first thread in messages, where it packs
 * nothing but waits for others and gives way to them. */
double toll_all(void);
double toll_messages(void);

#endif
