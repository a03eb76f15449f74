// One message over a socket of the decoder with at most one file descriptor attached.
#ifndef PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_MESSAGE_H
#define PETRICHOR_TEXPROC_CODECS_FILES_DETAIL_MESSAGE_H

#include <sys/socket.h>
#include <sys/uio.h>

#include <cstring>

namespace petrichor::texproc::detail {

/// Sends `content` whole, with a copy of `fd` unless it is negative. False when the other end is
/// gone; never raises SIGPIPE.
template <typename Content>
bool send_message(int socket, const Content& content, int fd)
{
    iovec data{const_cast<Content*>(&content), sizeof content};
    alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int))] = {};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    if (fd >= 0) {
        message.msg_control = control;
        message.msg_controllen = sizeof control;
        cmsghdr* c = CMSG_FIRSTHDR(&message);
        c->cmsg_level = SOL_SOCKET;
        c->cmsg_type = SCM_RIGHTS;
        c->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(c), &fd, sizeof fd);
    }
    return ::sendmsg(socket, &message, MSG_NOSIGNAL) == sizeof content;
}

}  // namespace petrichor::texproc::detail

#endif
