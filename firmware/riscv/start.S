# The first instructions of the core: registers that compiled code expects, and the FPU where there is one. Whoever
# plays the core has put the job's address into a0 and the stack's end into sp.
  .section .text.start, "ax"
  .globl hm_core_start, hm_core_idle
hm_core_start:
  .option push
  .option norelax
  la gp, __global_pointer$
  .option pop
#ifdef __riscv_flen
  li t0, 0x2000 # mstatus.FS: without it every instruction of the FPU is illegal
  csrs mstatus, t0
#endif
  call hm_core_begin
hm_core_idle: # where every call comes back to
  j hm_core_idle
