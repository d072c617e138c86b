// What a fuzz target is: this function. It is called with an input many times in one process, leaves nothing
// behind, and a breach of what must hold ends the process (CHECK). libFuzzer calls it in the preset `fuzz`,
// replay_main.cpp with the corpus in all others.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
