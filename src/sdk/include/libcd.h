#pragma once
// The drive under the older SDK's name.
#include "psxcd.h"
