#include "edit/cloud_digest.h"

#include "io/digest.h"

#include <exception>
#include <utility>

namespace knead {

CloudDigest::CloudDigest(std::filesystem::path file, const FileStamp& stamp) {
    thread_.emplace([this, file = std::move(file), stamp] {
        try {
            if (stamp_of(file) != stamp) return;
            std::optional<std::string> digest = sha256_of_file(file, &stop_);
            if (stamp_of(file) == stamp) digest_ = std::move(digest);
        } catch (const std::exception&) { // it cannot be read any more: there is none
        }
    });
}

CloudDigest::~CloudDigest() {
    stop_ = true;
}

const std::optional<std::string>& CloudDigest::get() {
    thread_.reset();
    return digest_;
}

} // namespace knead
