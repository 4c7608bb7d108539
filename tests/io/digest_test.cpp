#include "base/error.h"
#include "io/digest.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

std::string digest(std::string_view text) {
    return sha256_of(std::as_bytes(std::span(text.data(), text.size())));
}

// The examples of FIPS 180-4.
TEST(Digest, is_sha_256) {
    EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(digest(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Digest, of_a_file_is_that_of_its_bytes) {
    const ScratchFolder folder;
    for (const std::size_t size : {0U, 1U, 1048576U, 3000001U}) {
        const std::string text(size, 'k');
        write_text(folder / "file", text);
        EXPECT_EQ(sha256_of_file(folder / "file"), digest(text)) << size;
    }
}

TEST(Digest, refuses_what_cannot_be_read) {
    const ScratchFolder folder;
    EXPECT_THROW(sha256_of_file(folder / "missing"), Error);
    EXPECT_THROW(sha256_of_file(folder.path()), Error);
}

} // namespace
} // namespace knead::test
