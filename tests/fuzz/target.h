#pragma once
// What a fuzz target is: <name>_target.cpp implements these two functions. It is linked twice, with
// libFuzzer, which makes up inputs (libfuzzer_entry.cpp, see run.sh), and with a main() that replays the
// seeds and past finds as a test (replay_main.cpp).

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead::fuzz {

// Reads the bytes as an input and checks all that must hold of it. Returns whether they were accepted; bytes
// that are refused as they should be are no find. Any exception, sanitizer report, crash, hang or huge
// allocation is one.
bool run_target(std::span<const std::byte> bytes);

// An input that fuzzing begins with. Those whose name begins with "bad" must be refused, all others accepted.
struct Seed {
    std::string name; // fit for a file's
    std::string bytes;
};
std::vector<Seed> seeds();

// Throws BrokenInvariant unless the words of an Error, or a remark, can be shown as they are: not empty, not
// a page of text, in one line, without control characters, and beginning with `place`.
void require_showable(std::string_view words, std::string_view place);

} // namespace knead::fuzz
