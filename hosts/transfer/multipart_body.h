// MultipartBody: a form with a file (RFC 7578), made while it is sent.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hosts/transfer/upload_source.h"

namespace lamella {

/// A field of a form: name and value.
using FormField = std::pair<std::string, std::string>;

/// What a form says beside its file.
struct UploadForm {
    std::vector<FormField> before{};  ///< fields that come before the file
    std::string file_field = "file";
    std::string file_name;  ///< without quotes, backslashes and line ends
    /// Returns the fields that come after the file, from what it was; may be empty.
    std::function<std::vector<FormField>(const UploadFacts& sent)> after{};
};

/// The bytes of a form whose file comes from `bytes`, which it takes over.
class MultipartBody : public UploadBytes {
  public:
    MultipartBody(UploadForm form, std::unique_ptr<UploadBytes> bytes);

    std::optional<std::size_t> take(std::span<char> out) override;
    void on_ready(std::function<void()> wake) override { bytes_->on_ready(std::move(wake)); }

    /// The value of the Content-Type header.
    std::string content_type() const;
    /// Returns the size of the whole form for a file of this size. What comes after it must be of a length
    /// that does not depend on its bytes.
    std::uint64_t size_with(std::uint64_t file_size) const;
    /// What was taken of the file so far.
    UploadFacts sent() const { return digest_.facts(); }

  private:
    std::string tail() const;

    UploadForm form_;
    std::unique_ptr<UploadBytes> bytes_;
    UploadDigest digest_;
    std::string text_;  // to be taken before or after the file
    std::size_t text_at_ = 0;
    bool in_tail_ = false;
};

}  // namespace lamella
