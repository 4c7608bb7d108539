#include "base/error.h"
#include "io/digest.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

class Digest : public testing::Test {
protected:
    std::string digest(std::string_view text) {
        write_text(folder_ / "file", std::string(text));
        return sha256_of_file(folder_ / "file");
    }

    ScratchFolder folder_;
};

// The examples of FIPS 180-4.
TEST_F(Digest, is_sha_256) {
    EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(digest(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    EXPECT_EQ(digest(std::string(3000001, 'k')), digest(std::string(3000001, 'k')));
    EXPECT_NE(digest(std::string(3000001, 'k')), digest(std::string(3000000, 'k'))) << "block by block";
}

TEST_F(Digest, is_nothing_where_it_was_stopped) {
    digest("abc");
    std::atomic<bool> stop = false;
    EXPECT_EQ(sha256_of_file(folder_ / "file", &stop), sha256_of_file(folder_ / "file"));
    stop = true;
    EXPECT_FALSE(sha256_of_file(folder_ / "file", &stop));
}

TEST_F(Digest, refuses_what_cannot_be_read) {
    EXPECT_THROW(sha256_of_file(folder_ / "missing"), Error);
    EXPECT_THROW(sha256_of_file(folder_.path()), Error);
}

} // namespace
} // namespace knead::test
