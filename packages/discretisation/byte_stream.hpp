#pragma once

#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace mudline {

/// Values written to bytes, or read back in the same order. A type lists its members once, for both directions, in
/// `void transfer(ByteStream&)`. A type that other archives store too names its members in `template <class Archive>
/// void transfer(Archive&)`; a ByteStream ignores the names.
class ByteStream {
 public:
  /// An empty stream to write to.
  ByteStream() = default;
  /// A stream that reads from `bytes`.
  explicit ByteStream(std::vector<char> bytes) : bytes_(std::move(bytes)), reading_(true) {}

  const std::vector<char>& bytes() const { return bytes_; }

  template <class T>
  ByteStream& operator()(const char* /*name*/, T& value) {
    return (*this)(value);
  }
  template <class T>
  ByteStream& operator()(T& value) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      copy(&value, sizeof(T));
    } else {
      value.transfer(*this);
    }
    return *this;
  }
  ByteStream& operator()(std::string& text) {
    resize(text);
    copy(text.data(), text.size());
    return *this;
  }
  template <class T>
  ByteStream& operator()(std::vector<T>& values) {
    resize(values);
    if constexpr (std::is_trivially_copyable_v<T>) {
      copy(values.data(), values.size() * sizeof(T));
    } else {
      for (T& value : values) (*this)(value);
    }
    return *this;
  }
  template <class K, class V>
  ByteStream& operator()(std::map<K, V>& values) {
    std::vector<K> keys;
    for (const auto& item : values) keys.push_back(item.first);
    (*this)(keys);
    for (const K& key : keys) (*this)(values[key]);
    return *this;
  }

 private:
  template <class Container>
  void resize(Container& values) {
    auto size = static_cast<unsigned long long>(values.size());
    copy(&size, sizeof(size));
    values.resize(size);
  }
  void copy(void* data, std::size_t size) {
    if (size == 0) return;  // the pointer of an empty vector is null
    if (reading_) {
      std::memcpy(data, bytes_.data() + position_, size);
      position_ += size;
    } else {
      const char* first = static_cast<const char*>(data);
      bytes_.insert(bytes_.end(), first, first + size);
    }
  }

  std::vector<char> bytes_;
  std::size_t position_ = 0;
  bool reading_ = false;
};

}  // namespace mudline
