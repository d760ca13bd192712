/* The shared library is made of the C interface alone; this file shows that its header is C. */
#include "lamella.h"

typedef char lamella_statuses_are_exit_codes[LAMELLA_OK == 0 && LAMELLA_STOPPED == 130 ? 1 : -1];
