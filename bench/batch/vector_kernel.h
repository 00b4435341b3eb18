// For loops that become vector loops in several sets of instructions, chosen at run time.
#ifndef PLENUM_BENCH_BATCH_VECTOR_KERNEL_H_
#define PLENUM_BENCH_BATCH_VECTOR_KERNEL_H_

// Kernels are free of branches and calls, so that the loops over them become vector loops.
#define PLENUM_KERNEL [[gnu::always_inline]] inline

#ifdef __x86_64__
#define PLENUM_TARGET(name) [[gnu::target(name)]]
#else
#define PLENUM_TARGET(name)
#endif

namespace plenum::bench {

PLENUM_KERNEL double Min(double a, double b) { return a < b ? a : b; }
PLENUM_KERNEL double Max(double a, double b) { return a > b ? a : b; }

}  // namespace plenum::bench

#endif  // PLENUM_BENCH_BATCH_VECTOR_KERNEL_H_
