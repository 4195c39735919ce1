/* Of libsodium's core only this is asked for: how it ends a program that calls it wrongly. */
#include <stdlib.h>
void sodium_misuse(void) {
    abort();
}
