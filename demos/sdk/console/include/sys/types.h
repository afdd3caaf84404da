#pragma once
#include <stdint.h>

typedef uint32_t u_long;
typedef uint16_t u_short;
typedef uint8_t u_char;
