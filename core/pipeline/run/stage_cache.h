// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/base/content_hash.h"

namespace batten {

/// Outputs of stages by key, with a limit in bytes, least recently used out first. Thread-safe; the only object that
/// runs share. Errors and cancelled runs are never stored.
class StageCache {
 public:
  explicit StageCache(std::size_t limitBytes = std::size_t{512} << 20) : limit_(limitBytes) {}

  /// The stored output or null. The caller knows the type from the key (the key contains the stage).
  template <class T>
  std::shared_ptr<const T> find(const ContentHash& key) {
    return std::static_pointer_cast<const T>(findAny(key));
  }
  /// Stores an output that takes about `bytes`; one larger than the limit is not kept.
  void store(const ContentHash& key, std::shared_ptr<const void> value, std::size_t bytes);
  /// From now on; what is too much for it goes, least recently used first.
  void setLimit(std::size_t limitBytes);
  /// Everything stored so far, which it then no longer holds: to be freed where that may take a while. What is stored
  /// afterwards stays.
  std::vector<std::shared_ptr<const void>> release();
  std::size_t bytesUsed() const;

 private:
  struct Entry {
    std::shared_ptr<const void> value;
    std::size_t bytes;
    std::list<ContentHash>::iterator age;
  };
  std::shared_ptr<const void> findAny(const ContentHash& key);
  /// Takes out the oldest until so many bytes fit.
  std::vector<std::shared_ptr<const void>> makeRoom(std::size_t bytes);

  mutable std::mutex mutex_;
  std::map<ContentHash, Entry> entries_;
  std::list<ContentHash> ages_;  ///< Most recently used first.
  std::size_t limit_;
  std::size_t used_ = 0;
};

}  // namespace batten
