# Where a PS-EXE begins, and the coprocessor's registers by number.   [psx-spx, COP0, GTE Overview]
  .set noreorder
  .set noat

  .section .start, "ax"
  .globl start
start:
  mfc0 $8, $12            # the coprocessor on, interrupts off: blanks are polled
  lui $9, 0x4000
  or $8, $8, $9
  addiu $9, $0, -2
  and $8, $8, $9
  mtc0 $8, $12
  nop
  nop
  jal main
  nop
forever:
  b forever
  nop

  .text
# uint32_t otter_gte_get(unsigned number); 16 bytes of instructions for each number
  .globl otter_gte_get
otter_gte_get:
  lui $8, %hi(getters)
  addiu $8, $8, %lo(getters)
  sll $9, $4, 4
  addu $8, $8, $9
  jr $8
  nop
  .balign 16
getters:
  .irp n, 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  mfc2 $2, $\n
  nop
  jr $31
  nop
  .endr
  .irp n, 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  cfc2 $2, $\n
  nop
  jr $31
  nop
  .endr

# void otter_gte_put(unsigned number, uint32_t word)
  .globl otter_gte_put
otter_gte_put:
  lui $8, %hi(putters)
  addiu $8, $8, %lo(putters)
  sll $9, $4, 4
  addu $8, $8, $9
  jr $8
  nop
  .balign 16
putters:
  .irp n, 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  mtc2 $5, $\n
  nop
  jr $31
  nop
  .endr
  .irp n, 0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17,18,19,20,21,22,23,24,25,26,27,28,29,30,31
  ctc2 $5, $\n
  nop
  jr $31
  nop
  .endr
