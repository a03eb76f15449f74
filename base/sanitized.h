#ifndef PETRICHOR_BASE_SANITIZED_H
#define PETRICHOR_BASE_SANITIZED_H

// PETRICHOR_SANITIZED stands in builds with the address or thread sanitizer: they map terabytes, so
// that limits of address space mean nothing, and ask the system what memory may be read.
#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PETRICHOR_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PETRICHOR_SANITIZED
#endif

#endif
