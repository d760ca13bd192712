// The form's text, the file's bytes as they come, and text that may depend on them.
#include "hosts/transfer/multipart_body.h"

#include <algorithm>
#include <cstring>

namespace lamella {

namespace {

/// No text of ours and no G-code holds it; in binary files it is as improbable as a chosen hash.
constexpr const char* boundary = "lamella-5e3c0f7a9d1b4862-c4a7e19f8b2d6035";

std::string field_text(const FormField& field) {
    return std::string("--") + boundary + "\r\nContent-Disposition: form-data; name=\"" + field.first +
           "\"\r\n\r\n" + field.second + "\r\n";
}

}  // namespace

MultipartBody::MultipartBody(UploadForm form, std::unique_ptr<UploadBytes> bytes)
    : form_(std::move(form)), bytes_(std::move(bytes)) {
    for (const FormField& field : form_.before) text_ += field_text(field);
    text_ += std::string("--") + boundary + "\r\nContent-Disposition: form-data; name=\"" + form_.file_field +
             "\"; filename=\"" + form_.file_name + "\"\r\nContent-Type: application/octet-stream\r\n\r\n";
}

std::string MultipartBody::content_type() const {
    return std::string("multipart/form-data; boundary=") + boundary;
}

std::string MultipartBody::tail() const {
    std::string text = "\r\n";
    if (form_.after) {
        for (const FormField& field : form_.after(digest_.facts())) text += field_text(field);
    }
    return text + "--" + boundary + "--\r\n";
}

std::uint64_t MultipartBody::size_with(std::uint64_t file_size) const {
    return text_.size() + file_size + tail().size();
}

std::optional<std::size_t> MultipartBody::take(std::span<char> out) {
    if (text_at_ == text_.size()) {
        if (in_tail_) return std::nullopt;
        const std::optional<std::size_t> count = bytes_->take(out);
        if (count) {
            digest_.add(out.first(*count));
            return count;
        }
        in_tail_ = true;
        text_ = tail();
        text_at_ = 0;
    }
    const std::size_t count = std::min(out.size(), text_.size() - text_at_);
    std::memcpy(out.data(), text_.data() + text_at_, count);
    text_at_ += count;
    return count;
}

}  // namespace lamella
