// UploadDigest: size and hashes of bytes as they pass.
#pragma once

#include <openssl/evp.h>

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace lamella {

/// Size and hashes of an upload.
struct UploadFacts {
    std::uint64_t size = 0;  ///< bytes
    std::string sha256;      ///< lower-case hexadecimal digits
    std::string sha1;        ///< lower-case hexadecimal digits
    std::string md5;         ///< lower-case hexadecimal digits
    std::uint32_t crc32 = 0;
};

/// Counts and hashes bytes.
class UploadDigest {
  public:
    UploadDigest();
    void add(std::span<const char> bytes);
    /// Returns the facts of all bytes so far.
    UploadFacts facts() const;

  private:
    struct Free {
        void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
    };
    using Context = std::unique_ptr<EVP_MD_CTX, Free>;
    static Context begin(const EVP_MD* kind);
    static std::string hexadecimal(const Context& context);

    Context sha256_, sha1_, md5_;
    std::uint32_t crc32_ = 0;
    std::uint64_t size_ = 0;
};

}  // namespace lamella
