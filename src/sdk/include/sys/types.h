#pragma once
// The console's u_long has 32 bits. The system's own name for it is set aside.

#define u_long otter_system_u_long
#include_next <sys/types.h>
#undef u_long

#include <stdint.h>

typedef uint32_t u_long;
