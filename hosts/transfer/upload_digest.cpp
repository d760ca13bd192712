// Hashes by OpenSSL and zlib.
#include "hosts/transfer/upload_digest.h"

#include <fmt/format.h>
#include <zlib.h>

#include "engine/base/error.h"

namespace lamella {

UploadDigest::UploadDigest()
    : sha256_(begin(EVP_sha256())), sha1_(begin(EVP_sha1())), md5_(begin(EVP_md5())) {}

UploadDigest::Context UploadDigest::begin(const EVP_MD* kind) {
    Context context(EVP_MD_CTX_new());
    if (!context || EVP_DigestInit_ex(context.get(), kind, nullptr) != 1)
        throw FaultError("this computer's OpenSSL lacks SHA-256, SHA-1 or MD5, which uploads are checked by");
    return context;
}

void UploadDigest::add(std::span<const char> bytes) {
    EVP_DigestUpdate(sha256_.get(), bytes.data(), bytes.size());
    EVP_DigestUpdate(sha1_.get(), bytes.data(), bytes.size());
    EVP_DigestUpdate(md5_.get(), bytes.data(), bytes.size());
    crc32_ = static_cast<std::uint32_t>(
        ::crc32_z(crc32_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
    size_ += bytes.size();
}

std::string UploadDigest::hexadecimal(const Context& context) {
    const Context copy(EVP_MD_CTX_new());
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    if (!copy || EVP_MD_CTX_copy_ex(copy.get(), context.get()) != 1 ||
        EVP_DigestFinal_ex(copy.get(), digest, &length) != 1)
        throw FaultError("OpenSSL could not finish a hash");
    std::string text;
    for (unsigned int i = 0; i < length; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
}

UploadFacts UploadDigest::facts() const {
    return {size_, hexadecimal(sha256_), hexadecimal(sha1_), hexadecimal(md5_), crc32_};
}

}  // namespace lamella
