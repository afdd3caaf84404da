#pragma once
// The draw environment as words of GP0.

#include "sdk/call_site.h"
#include "sdk/include/psxgpu.h"

namespace sdk {

/// Makes env->dr_env and sends it. A null pointer is a finding at `site`.
void put_environment(DRAWENV* env, CallSite site);

}  // namespace sdk
