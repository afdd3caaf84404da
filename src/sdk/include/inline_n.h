#pragma once
// The older SDK's name of the coprocessor's macros.
#include "inline_c.h"
