/// Which instruction sets this machine runs, asked once at load.
#pragma once

namespace trg {

enum class Isa { baseline, avx2, avx512 };

/// The best set that was compiled in and that processor and system support.
Isa detect_isa();

const char* isa_name(Isa isa);

}  // namespace trg
