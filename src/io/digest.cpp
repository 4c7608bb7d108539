#include "io/digest.h"

#include "base/error.h"
#include "base/require.h"

#include <openssl/evp.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <span>
#include <system_error>
#include <vector>

namespace knead {

namespace {

class Sha256 {
public:
    Sha256() : context_(EVP_MD_CTX_new()) {
        require(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1,
                "OpenSSL offers SHA-256");
    }

    void add(std::span<const std::byte> bytes) {
        require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1, "SHA-256 takes bytes");
    }

    std::string finish() {
        std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
        unsigned size = 0;
        require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1, "SHA-256 comes to an end");
        constexpr std::string_view digits = "0123456789abcdef";
        std::string text;
        for (const unsigned char byte : std::span(digest).first(size)) {
            text += digits[byte >> 4U];
            text += digits[byte & 15U];
        }
        return text;
    }

private:
    struct Free {
        void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
    };
    std::unique_ptr<EVP_MD_CTX, Free> context_;
};

struct CloseFile {
    void operator()(std::FILE* file) const { (void)std::fclose(file); }
};

} // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
    return sha256_of_file(path, nullptr).value();
}

std::optional<std::string> sha256_of_file(const std::filesystem::path& path, const std::atomic<bool>* stop) {
    const auto fail = [&path](const char* doing) {
        throw Error(Trouble::input, path.string(),
                    std::string(doing) + ": " + std::generic_category().message(errno));
    };
    const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
    if (!file) fail("cannot be opened");
    Sha256 digest;
    std::vector<std::byte> block(std::size_t{1} << 20);
    while (const std::size_t got = std::fread(block.data(), 1, block.size(), file.get())) {
        if (stop && *stop) return std::nullopt;
        digest.add(std::span(block).first(got));
    }
    if (std::ferror(file.get()) != 0) fail("cannot be read");
    return digest.finish();
}

} // namespace knead
