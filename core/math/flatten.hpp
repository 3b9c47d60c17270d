// SPDX-License-Identifier: BSD-3-Clause
// POLHODE_FLATTEN before a function: inline all that it calls. The stages of a step of one body are small functions of
// small functions; left to itself, the compiler stops half way and the step costs two to three times as much. Only
// where the compiler optimises for speed: under a sanitizer a flattened function takes minutes to compile.
#pragma once

#if defined(__GNUC__) && !defined(__clang__) && defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define POLHODE_FLATTEN [[gnu::flatten]]
#else
#define POLHODE_FLATTEN
#endif
