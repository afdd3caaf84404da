#pragma once
// The kernel's calls under the older SDK's name.
#include <sys/types.h>

#include "psxapi.h"
