#pragma once
// The digest of the file that a cloud was read from, made beside all else. Private to this room.

#include "base/background.h"
#include "base/whole_file.h"

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

namespace knead {

class CloudDigest {
public:
    // Begins to read the file, which counts only while it is the one of that stamp.
    CloudDigest(std::filesystem::path file, const FileStamp& stamp);
    // Stops reading.
    ~CloudDigest();
    CloudDigest(const CloudDigest&) = delete;
    CloudDigest& operator=(const CloudDigest&) = delete;

    // Waits for it. Nothing where the file was another one before all of it was read, or cannot be read.
    const std::optional<std::string>& get();

private:
    std::atomic<bool> stop_ = false;
    std::optional<std::string> digest_; // the thread's, until it has been waited for
    std::optional<Background> thread_;
};

} // namespace knead
