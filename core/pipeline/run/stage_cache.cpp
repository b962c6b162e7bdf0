// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/pipeline/run/stage_cache.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace batten {

std::shared_ptr<const void> StageCache::findAny(const ContentHash& key) {
  const std::scoped_lock lock(mutex_);
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  ages_.splice(ages_.begin(), ages_, found->second.age);
  return found->second.value;
}

void StageCache::store(const ContentHash& key, std::shared_ptr<const void> value, std::size_t bytes) {
  // Dropped values are destroyed after the lock is released: freeing a page-sized picture takes a while.
  std::vector<std::shared_ptr<const void>> dropped;
  const std::scoped_lock lock(mutex_);
  if (const auto old = entries_.find(key); old != entries_.end()) {
    used_ -= old->second.bytes;
    dropped.push_back(std::move(old->second.value));
    ages_.erase(old->second.age);
    entries_.erase(old);
  }
  if (bytes > limit_) return;
  std::ranges::move(makeRoom(bytes), std::back_inserter(dropped));
  ages_.push_front(key);
  entries_.emplace(key, Entry{std::move(value), bytes, ages_.begin()});
  used_ += bytes;
}

void StageCache::setLimit(std::size_t limitBytes) {
  std::vector<std::shared_ptr<const void>> dropped;  // destroyed after the lock is released
  const std::scoped_lock lock(mutex_);
  limit_ = limitBytes;
  dropped = makeRoom(0);
}

std::vector<std::shared_ptr<const void>> StageCache::makeRoom(std::size_t bytes) {
  std::vector<std::shared_ptr<const void>> dropped;
  while (used_ + bytes > limit_) {
    const auto oldest = entries_.find(ages_.back());
    used_ -= oldest->second.bytes;
    dropped.push_back(std::move(oldest->second.value));
    entries_.erase(oldest);
    ages_.pop_back();
  }
  return dropped;
}

std::vector<std::shared_ptr<const void>> StageCache::release() {
  std::vector<std::shared_ptr<const void>> released;
  const std::scoped_lock lock(mutex_);
  released.reserve(entries_.size());
  for (auto& [key, entry] : entries_) released.push_back(std::move(entry.value));
  entries_.clear();
  ages_.clear();
  used_ = 0;
  return released;
}

std::size_t StageCache::bytesUsed() const {
  const std::scoped_lock lock(mutex_);
  return used_;
}

}  // namespace batten
