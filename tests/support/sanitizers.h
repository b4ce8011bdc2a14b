#pragma once

/// Whether this is built with the address or thread sanitizer, of GCC or clang: 1 or 0.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PLIANT_IS_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PLIANT_IS_SANITIZED 1
#endif
#endif
#ifndef PLIANT_IS_SANITIZED
#define PLIANT_IS_SANITIZED 0
#endif
