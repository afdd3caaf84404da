#pragma once
// The drive. There is no disc here: every call fails and says so once.

#include <stdint.h>

typedef enum {
  CdlNop = 0x01,
  CdlSetloc = 0x02,
  CdlPlay = 0x03,
  CdlReadN = 0x06,
  CdlStop = 0x08,
  CdlPause = 0x09,
  CdlInit = 0x0a,
  CdlMute = 0x0b,
  CdlDemute = 0x0c,
  CdlSetfilter = 0x0d,
  CdlSetmode = 0x0e,
  CdlGetlocL = 0x10,
  CdlGetlocP = 0x11,
  CdlGetTN = 0x13,
  CdlGetTD = 0x14,
  CdlSeekL = 0x15,
  CdlSeekP = 0x16,
  CdlReadS = 0x1b
} CdlCommand;

typedef enum {
  CdlModeDA = 1 << 0,
  CdlModeAP = 1 << 1,
  CdlModeRept = 1 << 2,
  CdlModeSF = 1 << 3,
  CdlModeIgnore = 1 << 4,
  CdlModeSize = 1 << 5,
  CdlModeRT = 1 << 6,
  CdlModeSpeed = 1 << 7
} CdlModeFlag;

typedef enum {
  CdlNoIntr = 0,
  CdlDataReady = 1,
  CdlComplete = 2,
  CdlAcknowledge = 3,
  CdlDataEnd = 4,
  CdlDiskError = 5
} CdlIntrResult;

typedef enum {
  CdlIsoOkay = 0,
  CdlIsoSeekError = 1,
  CdlIsoReadError = 2,
  CdlIsoInvalidFs = 3,
  CdlIsoLidOpen = 4
} CdlIsoError;

#define btoi(b) ((b) / 16 * 10 + (b) % 16)
#define itob(i) ((i) / 10 * 16 | (i) % 10)

typedef struct {
  uint8_t minute, second, sector, track;  ///< binary-coded decimal
} CdlLOC;
typedef struct {
  CdlLOC pos;
  int size;
  char name[16];
} CdlFILE;
typedef struct {
  uint8_t val0, val1, val2, val3;
} CdlATV;
typedef struct {
  uint8_t file, chan;
  uint16_t pad;
} CdlFILTER;
typedef void* CdlDIR;
typedef void (*CdlCB)(CdlIntrResult, uint8_t*);

#ifdef __cplusplus
extern "C" {
#endif

CdlLOC* CdIntToPos(int i, CdlLOC* p);  ///< sector number to minute, second, sector, 150 sectors in
int CdPosToInt(const CdlLOC* p);
int CdInit(void);  ///< 0: failed
int CdControl(CdlCommand cmd, const void* param, uint8_t* result);
int CdControlB(CdlCommand cmd, const void* param, uint8_t* result);
int CdControlF(CdlCommand cmd, const void* param);
CdlIntrResult CdSync(int mode, uint8_t* result);
CdlCB CdSyncCallback(CdlCB func);
CdlCB CdReadyCallback(CdlCB func);
int CdGetSector(void* madr, int size);
int CdRead(int sectors, uint32_t* buf, int mode);
int CdReadSync(int mode, uint8_t* result);  ///< -1: failed
void CdReadBreak(void);
CdlCB CdReadCallback(CdlCB func);
int CdMix(const CdlATV* vol);
CdlFILE* CdSearchFile(CdlFILE* loc, const char* filename);  ///< null: not found
CdlDIR* CdOpenDir(const char* path);
int CdReadDir(CdlDIR* dir, CdlFILE* file);
void CdCloseDir(CdlDIR* dir);
CdlIsoError CdIsoError(void);

#ifdef __cplusplus
}
#endif
