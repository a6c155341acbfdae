// SPDX-License-Identifier: Apache-2.0
// The sequence viewer: a page on this machine's loopback, for nobody else.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace pfseq {

/// Serves a page to leaf through a sequence at http://127.0.0.1:PORT/ until the process
/// ends. Only GET is answered, and only for this machine's own names in the Host header, so that a
/// page from elsewhere cannot ask through a name that it lets point here (DNS rebinding).
///
///   /                                              the page
///   /sequence                                      SequenceView::Description
///   /picture?lens=&camera=&channel=&frame=         SequenceView::Picture
///   /pixel?lens=&camera=&frame=&x=&y=              SequenceView::Pixel
///
/// `port` 0 takes a free one. `is_ready` is told the address before the first request is answered.
/// InputError when the folder is no sequence, SystemError when the port cannot be had.
void ServeSequence(const std::filesystem::path& folder,
                   int port,
                   const std::function<void(const std::string& address)>& is_ready);

/// Whether a request's Host header is one of this machine's own names with this port.
bool IsOwnHost(const std::string& host, int port);

}  // namespace pfseq
