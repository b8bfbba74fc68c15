// HM_WIDEST before a function of plain loops: it is compiled for several kinds of processor, and the loader
// picks the widest version that this one can run. Sanitizers are not yet there when the loader picks.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define HM_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HM_WIDEST
#endif
