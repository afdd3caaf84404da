#pragma once
// What a controller's answer means. Buttons are 0 while held.   [psx-spx, Controllers]

#include <stdint.h>

typedef enum {
  PAD_SELECT = 1 << 0,
  PAD_L3 = 1 << 1,
  PAD_R3 = 1 << 2,
  PAD_START = 1 << 3,
  PAD_UP = 1 << 4,
  PAD_RIGHT = 1 << 5,
  PAD_DOWN = 1 << 6,
  PAD_LEFT = 1 << 7,
  PAD_L2 = 1 << 8,
  PAD_R2 = 1 << 9,
  PAD_L1 = 1 << 10,
  PAD_R1 = 1 << 11,
  PAD_TRIANGLE = 1 << 12,
  PAD_CIRCLE = 1 << 13,
  PAD_CROSS = 1 << 14,
  PAD_SQUARE = 1 << 15,
  MOUSE_RIGHT = 1 << 10,
  MOUSE_LEFT = 1 << 11,
  NCON_START = 1 << 3,
  NCON_UP = 1 << 4,
  NCON_RIGHT = 1 << 5,
  NCON_DOWN = 1 << 6,
  NCON_LEFT = 1 << 7,
  NCON_R = 1 << 11,
  NCON_B = 1 << 12,
  NCON_A = 1 << 13,
  GCON_A = 1 << 3,
  GCON_TRIGGER = 1 << 13,
  GCON_B = 1 << 14
} PadButton;

typedef enum {
  PAD_ID_MOUSE = 1,
  PAD_ID_NEGCON = 2,
  PAD_ID_IRQ10_GUN = 3,
  PAD_ID_DIGITAL = 4,
  PAD_ID_ANALOG_STICK = 5,
  PAD_ID_GUNCON = 6,
  PAD_ID_ANALOG = 7,
  PAD_ID_MULTITAP = 8,
  PAD_ID_JOGCON = 14,
  PAD_ID_CONFIG_MODE = 15,
  PAD_ID_NONE = 15
} PadTypeID;

typedef struct __attribute__((packed)) _PADTYPE {
  uint8_t stat;               ///< 0: an answer came
  uint8_t len : 4, type : 4;  ///< halfwords that follow; PadTypeID
  uint16_t btn;
  __extension__ union {
    __extension__ struct {
      uint8_t rs_x, rs_y, ls_x, ls_y;  ///< sticks, 80h in the middle
      uint8_t press[12];
    };
    __extension__ struct { int8_t x_mov, y_mov; };
    __extension__ struct { uint8_t twist, btn_i, btn_ii, trg_l; };
    __extension__ struct { uint16_t jog_rot; };
    __extension__ struct { uint16_t gun_x, gun_y; };
  };
} PADTYPE;
