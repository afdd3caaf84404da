// The drive that is not there.

#include "sdk/console.h"
#include "sdk/include/psxcd.h"

namespace {

void refuse(const char* call, sdk::CallSite site) {
  sdk::the_console().lint.note("no-disc", site, std::string(call) + " fails: there is no disc here");
}

constexpr int sectors_a_second = 75, seconds_a_minute = 60, lead_in = 150;

std::uint8_t decimal(int n) { return static_cast<std::uint8_t>(itob(n)); }

}  // namespace

extern "C" {

CdlLOC* CdIntToPos(int i, CdlLOC* p) {
  i += lead_in;
  p->sector = decimal(i % sectors_a_second);
  p->second = decimal(i / sectors_a_second % seconds_a_minute);
  p->minute = decimal(i / sectors_a_second / seconds_a_minute);
  return p;
}
int CdPosToInt(const CdlLOC* p) {
  return (btoi(p->minute) * seconds_a_minute + btoi(p->second)) * sectors_a_second + btoi(p->sector) -
         lead_in;
}

int CdInit(void) { return refuse("CdInit", __builtin_return_address(0)), 0; }
int CdControl(CdlCommand, const void*, uint8_t*) {
  return refuse("CdControl", __builtin_return_address(0)), 0;
}
int CdControlB(CdlCommand, const void*, uint8_t*) {
  return refuse("CdControlB", __builtin_return_address(0)), 0;
}
int CdControlF(CdlCommand, const void*) { return refuse("CdControlF", __builtin_return_address(0)), 0; }
CdlIntrResult CdSync(int, uint8_t*) { return CdlDiskError; }
CdlCB CdSyncCallback(CdlCB) { return nullptr; }
CdlCB CdReadyCallback(CdlCB) { return nullptr; }
int CdGetSector(void*, int) { return refuse("CdGetSector", __builtin_return_address(0)), 0; }
int CdRead(int, uint32_t*, int) { return refuse("CdRead", __builtin_return_address(0)), 0; }
int CdReadSync(int, uint8_t*) { return -1; }
void CdReadBreak(void) {}
CdlCB CdReadCallback(CdlCB) { return nullptr; }
int CdMix(const CdlATV*) { return 0; }
CdlFILE* CdSearchFile(CdlFILE*, const char*) {
  return refuse("CdSearchFile", __builtin_return_address(0)), nullptr;
}
CdlDIR* CdOpenDir(const char*) { return refuse("CdOpenDir", __builtin_return_address(0)), nullptr; }
int CdReadDir(CdlDIR*, CdlFILE*) { return 0; }
void CdCloseDir(CdlDIR*) {}
CdlIsoError CdIsoError(void) { return CdlIsoLidOpen; }

}  // extern "C"
