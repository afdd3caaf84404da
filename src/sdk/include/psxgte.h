#pragma once
// Vectors, matrices and the functions on them. Angles: 4096 (isin, icos, RotMatrix) or 131072 (hi...) a turn.
// Matrix elements, sines and scales are 1.3.12: 4096 is one.

#include <stdint.h>

#define ONE (1 << 12)

typedef struct _MATRIX {
  int16_t m[3][3];  ///< [row][column]
  int32_t t[3];
} MATRIX;
// The older SDK's vectors have a fourth word (libgte.h), which no function reads or writes.
#ifndef OTTER_VECTOR_PAD
#define OTTER_VECTOR_PAD
#endif
typedef struct _VECTOR {
  int32_t vx, vy, vz;
  OTTER_VECTOR_PAD
} VECTOR;
typedef struct _SVECTOR {
  int16_t vx, vy, vz, pad;
} SVECTOR;
typedef struct _CVECTOR {
  uint8_t r, g, b, cd;
} CVECTOR;
typedef struct _DVECTOR {
  int16_t vx, vy;
} DVECTOR;

#define csin(a) isin(a)
#define ccos(a) icos(a)
#define rsin(a) isin(a)
#define rcos(a) icos(a)

#ifdef __cplusplus
extern "C" {
#endif

int isin(int a);
int icos(int a);
int hisin(int a);
int hicos(int a);

/// H 320, offset 0, the depth scales and the depth cue as the SDK sets them.
void InitGeom(void);

int SquareRoot12(int v);  ///< of a 20.12 number, 20.12
int SquareRoot0(int v);   ///< of an integer

/// Rotation matrix and translation, on a stack.
void PushMatrix(void);
void PopMatrix(void);

MATRIX* RotMatrix(SVECTOR* r, MATRIX* m);    ///< X * Y * Z; leaves m->t
MATRIX* HiRotMatrix(VECTOR* r, MATRIX* m);   ///< the same with fine angles
MATRIX* TransMatrix(MATRIX* m, VECTOR* r);   ///< sets m->t
MATRIX* ScaleMatrix(MATRIX* m, VECTOR* s);   ///< row i times s[i]
MATRIX* ScaleMatrixL(MATRIX* m, VECTOR* s);  ///< column i times s[i]
// The products run in the coprocessor: they saturate, and leave their left operand in its registers.
MATRIX* MulMatrix(MATRIX* m0, MATRIX* m1);  ///< m0 = m0 * m1
MATRIX* MulMatrix0(MATRIX* m0, MATRIX* m1, MATRIX* m2);
MATRIX* CompMatrixLV(MATRIX* v0, MATRIX* v1, MATRIX* v2);  ///< v2 = v0 after v1, translations too
VECTOR* ApplyMatrixLV(MATRIX* m, VECTOR* v0, VECTOR* v1);
void VectorNormalS(VECTOR* v0, SVECTOR* v1);  ///< length 4096, for components of 16 bits
void Square0(VECTOR* v0, VECTOR* v1);

#ifdef __cplusplus
}
#endif
