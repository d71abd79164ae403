// Includes the file PELAGE_LOOPS once per instruction set, each time in a namespace of its own. There PELAGE_TARGET
// stands before every function, and PELAGE_LANES is the number of floats in a register. Included inside of a namespace.

#define PELAGE_TARGET
#define PELAGE_LANES 4
namespace baseline {
#include PELAGE_LOOPS
}
#undef PELAGE_TARGET
#undef PELAGE_LANES

#ifdef __x86_64__
#define PELAGE_TARGET __attribute__((target("avx2")))
#define PELAGE_LANES 8
namespace avx2 {
#include PELAGE_LOOPS
}
#undef PELAGE_TARGET
#undef PELAGE_LANES

#define PELAGE_TARGET __attribute__((target("avx2,avx512f,avx512vl,avx512dq")))
#define PELAGE_LANES 16
namespace avx512 {
#include PELAGE_LOOPS
}
#undef PELAGE_TARGET
#undef PELAGE_LANES
#else
namespace avx2 = baseline;
namespace avx512 = baseline;
#endif
