// SPDX-License-Identifier: Apache-2.0
#include "pairing/certificates.hpp"

#include <openssl/ec.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <array>
#include <ctime>
#include <stdexcept>

namespace telehug {
namespace {

constexpr const char* organisation = "telehug";
constexpr long x509_version_3 = 2;

void must(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("OpenSSL could not ") + what);
}

BioHandle memory() {
  BioHandle bio(BIO_new(BIO_s_mem()));
  must(bio != nullptr, "take memory");
  return bio;
}

void set_name(X509_NAME* name, const std::string& common_name) {
  const auto add = [name](const char* field, const std::string& text) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.c_str());
    must(X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8, bytes, -1, -1, 0) == 1, "name a certificate");
  };
  add("O", organisation);
  add("CN", common_name);
}

void add_extension(X509* certificate, int kind, const char* value) {
  const std::unique_ptr<X509_EXTENSION, FreedBy<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, nullptr, kind, value));
  must(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "extend a certificate");
}

CertificateHandle begin_certificate(EVP_PKEY* holder, const std::string& common_name, const Validity& validity) {
  CertificateHandle certificate(X509_new());
  must(certificate != nullptr, "make a certificate");
  std::array<unsigned char, 16> serial{};
  must(RAND_bytes(serial.data(), static_cast<int>(serial.size())) == 1, "find randomness");
  serial[0] &= 0x7FU;  // a positive number, at most 20 bytes (RFC 5280, 4.1.2.2)
  const std::unique_ptr<BIGNUM, FreedBy<BN_free>> number(
      BN_bin2bn(serial.data(), static_cast<int>(serial.size()), nullptr));
  must(number && BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate.get())) != nullptr &&
           X509_set_version(certificate.get(), x509_version_3) == 1 &&
           X509_set_pubkey(certificate.get(), holder) == 1 &&
           ASN1_TIME_set(X509_getm_notBefore(certificate.get()), validity.from.time_since_epoch().count()) != nullptr &&
           ASN1_TIME_set(X509_getm_notAfter(certificate.get()), validity.until.time_since_epoch().count()) != nullptr,
       "fill in a certificate");
  set_name(X509_get_subject_name(certificate.get()), common_name);
  return certificate;
}

WallTime time_of(const ASN1_TIME* time) {
  std::tm broken_down{};
  if (ASN1_TIME_to_tm(time, &broken_down) != 1) return {};
  return WallTime(std::chrono::seconds(timegm(&broken_down)));
}

}  // namespace

KeyHandle make_key() {
  KeyHandle key(EVP_EC_gen("P-256"));
  must(key != nullptr, "make a key");
  return key;
}

std::string pem_of(EVP_PKEY* key) {
  const BioHandle bio = memory();
  must(PEM_write_bio_PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1, "write a key");
  return content_of(bio.get());
}

std::string pem_of(X509* certificate) {
  const BioHandle bio = memory();
  must(PEM_write_bio_X509(bio.get(), certificate) == 1, "write a certificate");
  return content_of(bio.get());
}

std::string signing_request(EVP_PKEY* key, const std::string& common_name) {
  const RequestHandle request(X509_REQ_new());
  must(request && X509_REQ_set_pubkey(request.get(), key) == 1, "make a request");
  set_name(X509_REQ_get_subject_name(request.get()), common_name);
  const BioHandle bio = memory();
  must(X509_REQ_sign(request.get(), key, EVP_sha256()) > 0 && PEM_write_bio_X509_REQ(bio.get(), request.get()) == 1,
       "sign a request");
  return content_of(bio.get());
}

CertificateHandle make_authority(EVP_PKEY* key, const std::string& common_name, const Validity& validity) {
  CertificateHandle certificate = begin_certificate(key, common_name, validity);
  add_extension(certificate.get(), NID_basic_constraints, "critical,CA:TRUE,pathlen:0");
  add_extension(certificate.get(), NID_key_usage, "critical,keyCertSign,digitalSignature");
  must(X509_set_issuer_name(certificate.get(), X509_get_subject_name(certificate.get())) == 1 &&
           X509_sign(certificate.get(), key, EVP_sha256()) > 0,
       "sign an authority");
  return certificate;
}

CertificateHandle issue(EVP_PKEY* holder, const std::string& common_name, X509* authority, EVP_PKEY* authority_key,
                        const Validity& validity) {
  CertificateHandle certificate = begin_certificate(holder, common_name, validity);
  add_extension(certificate.get(), NID_basic_constraints, "critical,CA:FALSE");
  add_extension(certificate.get(), NID_key_usage, "critical,digitalSignature,keyAgreement");
  must(X509_set_issuer_name(certificate.get(), X509_get_subject_name(authority)) == 1 &&
           X509_sign(certificate.get(), authority_key, EVP_sha256()) > 0,
       "sign a certificate");
  return certificate;
}

std::string sign(const std::string& document, X509* authority, EVP_PKEY* authority_key) {
  constexpr int flags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const BioHandle in = bio_of(document);
  const SignatureHandle signature(PKCS7_sign(authority, authority_key, nullptr, in.get(), flags));
  const BioHandle out = memory();
  must(signature && SMIME_write_PKCS7(out.get(), signature.get(), in.get(), flags) == 1, "sign a document");
  return content_of(out.get());
}

std::string random_hex(std::size_t bytes) {
  std::string hex;
  for (std::size_t i = 0; i < bytes; ++i) {
    unsigned char byte = 0;
    must(RAND_bytes(&byte, 1) == 1, "find randomness");
    constexpr const char* digits = "0123456789abcdef";
    hex += digits[byte >> 4U];
    hex += digits[byte & 15U];
  }
  return hex;
}

std::string sha256(const std::string& bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  must(EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) == 1, "make a digest");
  return {digest.begin(), digest.begin() + size};
}

std::string der_of(X509* certificate) {
  const BioHandle bio = memory();
  must(i2d_X509_bio(bio.get(), certificate) == 1, "write a certificate");
  return content_of(bio.get());
}

std::string public_der_of(EVP_PKEY* key) {
  const BioHandle bio = memory();
  must(i2d_PUBKEY_bio(bio.get(), key) == 1, "write a public key");
  return content_of(bio.get());
}

KeyHandle read_key(const std::string& pem) {
  const BioHandle bio = bio_of(pem);
  return KeyHandle(PEM_read_bio_PrivateKey(bio.get(), nullptr, nullptr, nullptr));
}

CertificateHandle read_certificate(const std::string& pem) {
  const BioHandle bio = bio_of(pem);
  return CertificateHandle(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
}

Result<KeyHandle> read_signing_request(const std::string& pem) {
  const BioHandle bio = bio_of(pem);
  const RequestHandle request(PEM_read_bio_X509_REQ(bio.get(), nullptr, nullptr, nullptr));
  if (!request) return Error{"it holds no certificate signing request"};
  KeyHandle key(X509_REQ_get_pubkey(request.get()));
  std::array<char, 32> group{};
  if (!key || EVP_PKEY_get_group_name(key.get(), group.data(), group.size(), nullptr) != 1 ||
      std::string_view(group.data()) != SN_X9_62_prime256v1) {
    return Error{"its key is not an EC key on P-256"};
  }
  if (X509_REQ_verify(request.get(), key.get()) != 1) return Error{"it is not signed with its own key"};
  return key;
}

Result<std::string> read_signed(const std::string& smime, X509* authority) {
  const BioHandle in = bio_of(smime);
  BIO* content = nullptr;
  const SignatureHandle signature(SMIME_read_PKCS7(in.get(), &content));
  const BioHandle signed_content(content);
  if (!signature || !content || !PKCS7_type_is_signed(signature.get())) return Error{"it is no signed document"};
  // As sign() makes it; of a digest that it does not know, and of every further one, OpenSSL 3.0 leaks memory.
  const STACK_OF(X509_ALGOR)* digests = signature->d.sign->md_algs;
  if (sk_X509_ALGOR_num(digests) != 1 || OBJ_obj2nid(sk_X509_ALGOR_value(digests, 0)->algorithm) != NID_sha256)
    return Error{"it is not signed with SHA-256"};
  const std::unique_ptr<STACK_OF(X509), FreedBy<[](STACK_OF(X509) * stack) { sk_X509_free(stack); }>> authorities(
      sk_X509_new_null());
  must(authorities && sk_X509_push(authorities.get(), authority) > 0, "take memory");
  const BioHandle out = memory();
  // The signer must be this very authority (PKCS7_NOINTERN: none that the document brings along), as Fast DDS wants it.
  constexpr int flags = PKCS7_TEXT | PKCS7_NOVERIFY | PKCS7_NOINTERN;
  if (PKCS7_verify(signature.get(), authorities.get(), nullptr, content, out.get(), flags) != 1) {
    return Error{"it is not signed by the pair's authority, or was changed afterwards"};
  }
  return content_of(out.get());
}

bool issued_by(X509* certificate, X509* authority) {
  const std::unique_ptr<X509_STORE, FreedBy<X509_STORE_free>> store(X509_STORE_new());
  const std::unique_ptr<X509_STORE_CTX, FreedBy<X509_STORE_CTX_free>> context(X509_STORE_CTX_new());
  must(store && context && X509_STORE_add_cert(store.get(), authority) == 1 &&
           X509_STORE_CTX_init(context.get(), store.get(), certificate, nullptr) == 1,
       "verify a certificate");
  X509_STORE_CTX_set_flags(context.get(),
                           X509_V_FLAG_CHECK_SS_SIGNATURE | X509_V_FLAG_POLICY_CHECK | X509_V_FLAG_NO_CHECK_TIME);
  return X509_verify_cert(context.get()) == 1;
}

bool signs_itself(X509* authority) {
  return X509_verify(authority, X509_get0_pubkey(authority)) == 1;
}

bool belongs_to(X509* certificate, EVP_PKEY* key) {
  return EVP_PKEY_eq(X509_get0_pubkey(certificate), key) == 1;
}

Validity validity_of(const X509* certificate) {
  return {time_of(X509_get0_notBefore(certificate)), time_of(X509_get0_notAfter(certificate))};
}

std::string subject_of(const X509* certificate) {
  const BioHandle bio = memory();
  must(X509_NAME_print_ex(bio.get(), X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253) >= 0, "write a name");
  return content_of(bio.get());
}

}  // namespace telehug
