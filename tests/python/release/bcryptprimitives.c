/* wine 8 lacks this library of Windows 10, from which Rust's standard library takes the seeds of its hash maps. Real Windows has it. */
#include <windows.h>

#include <ntsecapi.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(PBYTE data, SIZE_T size) { return RtlGenRandom(data, (ULONG)size); }
