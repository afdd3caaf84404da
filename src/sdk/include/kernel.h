#pragma once
// The kernel's descriptors under the older SDK's name.
#include "psxapi.h"
