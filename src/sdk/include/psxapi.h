#pragma once
// The kernel's calls, as far as drawing programs use them: controllers, critical sections, root counters.
// Events, files and threads of the kernel have no counterpart here; C's own files work.

#include <stddef.h>
#include <stdint.h>

typedef enum _EventDescriptor {
  DescMask = (int)0xff000000,
  DescTH = (int)0xff000000,
  DescHW = (int)0xf0000000,
  DescEV = (int)0xf1000000,
  DescRC = (int)0xf2000000,
  DescUEV = (int)0xf3000000,
  DescSW = (int)0xf4000000
} EventDescriptor;

typedef enum _EventType {
  HwVBLANK = DescHW | 1,
  HwGPU = DescHW | 2,
  RCntCNT0 = DescRC | 0,  ///< pixel clock
  RCntCNT1 = DescRC | 1,  ///< lines
  RCntCNT2 = DescRC | 2,  ///< system clock / 8
  RCntCNT3 = DescRC | 3   ///< vertical blanks
} EventType;

typedef enum _EventFlag {
  EvSpIOE = 1 << 2,
  EvSpTIMOUT = 1 << 8,
  EvSpNEW = 1 << 13,
  EvSpERROR = 1 << 15,
  EvMdINTR = 1 << 12,
  EvMdNOINTR = 1 << 13,
  RCntMdSP = 0,
  RCntMdFR = 0,
  RCntMdSC = 1 << 0,
  RCntMdGATE = 1 << 4,
  RCntMdINTR = 1 << 12,
  RCntMdNOINTR = 1 << 13
} EventFlag;

#define FastEnterCriticalSection() EnterCriticalSection()
#define FastExitCriticalSection() ExitCriticalSection()

#ifdef __cplusplus
extern "C" {
#endif

int EnterCriticalSection(void);  ///< 1 if callbacks could run before
void ExitCriticalSection(void);

/// Every vertical blank puts what the controllers say into the two buffers, as much as their lengths hold.
void InitPAD(uint8_t* buff1, int len1, uint8_t* buff2, int len2);
void StartPAD(void);
void StopPAD(void);
void ChangeClearPAD(int mode);
void ChangeClearRCnt(int t, int m);

// Root counters: time by the number of vertical blanks, so that two runs count alike.
int SetRCnt(int spec, uint16_t target, int mode);
int GetRCnt(int spec);
int StartRCnt(int spec);
int StopRCnt(int spec);
int ResetRCnt(int spec);

void FlushCache(void);
void _boot(void);  ///< ends the program

#ifdef __cplusplus
}
#endif
