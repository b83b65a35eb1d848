/* The controller as a process: connects to the plant on this machine and answers its frames until it hangs up.

   ridelab_ecu PORT, with a token of 32 bytes on standard input that the plant gave out for this one connection.
   All numbers are little-endian, 32 bits each.
   hello: "RIDELAB1", the token, the tables' fingerprint.
   frame: step, stage, codes. answer: step, two commands, flags, iterations, slack as a float, operations, time taken [ns]. */
#define _POSIX_C_SOURCE 200809L
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "ridelab_controller.h"
#include "ridelab_count.h"
#include "ridelab_prepare.h"

#define TOKEN 32
#define WORDS_AHEAD 2
#define ANSWER 8

enum { DONE = 0, USAGE = 2, NO_TABLES = 3, NO_PLANT = 4, BROKEN = 5 };

uint32_t ridelab_counted;

static ridelab_controller controller;
static ridelab_input input;

static void put(unsigned char *place, uint32_t word)
{
    for (int i = 0; i < 4; i++) {
        place[i] = (unsigned char)(word >> (8 * i));
    }
}

static int32_t get(const unsigned char *place)
{
    uint32_t word = 0;
    for (int i = 0; i < 4; i++) {
        word |= (uint32_t)place[i] << (8 * i);
    }
    return (int32_t)word;
}

/* 1 when all of it came, 0 where the plant hung up before the first byte, -1 otherwise. */
static int receive_all(int link, unsigned char *place, size_t length)
{
    size_t have = 0;
    while (have < length) {
        const ssize_t got = recv(link, place + have, length - have, 0);
        if (got <= 0) {
            return got == 0 && have == 0 ? 0 : -1;
        }
        have += (size_t)got;
    }
    return 1;
}

static int send_all(int link, const unsigned char *place, size_t length)
{
    size_t sent = 0;
    while (sent < length) {
        const ssize_t went = send(link, place + sent, length - sent, MSG_NOSIGNAL);
        if (went <= 0) {
            return 0;
        }
        sent += (size_t)went;
    }
    return 1;
}

static int connect_to(int port)
{
    struct sockaddr_in plant = {0};
    const int yes = 1;
    const int link = socket(AF_INET, SOCK_STREAM, 0);
    if (link < 0) {
        return -1;
    }
    plant.sin_family = AF_INET;
    plant.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    plant.sin_port = htons((uint16_t)port);
    if (connect(link, (const struct sockaddr *)&plant, sizeof plant) != 0
        || setsockopt(link, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes) != 0) {
        return -1;
    }
    return link;
}

static uint32_t nanoseconds_since(const struct timespec *begin)
{
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint32_t)((now.tv_sec - begin->tv_sec) * 1000000000L + (now.tv_nsec - begin->tv_nsec));
}

static int serve(int link, const ridelab_tables *tables)
{
    static unsigned char frame[4 * (WORDS_AHEAD + RIDELAB_CODES)];
    unsigned char answer[4 * ANSWER];
    const int32_t codes = RIDELAB_STATES + RIDELAB_PREVIEWED * tables->previewed;
    ridelab_init(&controller, tables);
    for (;;) {
        ridelab_output output = {{0, 0}, 0, 0.0f};
        struct timespec begin;
        uint32_t slack;
        int32_t flags;
        const int got = receive_all(link, frame, 4 * (size_t)(WORDS_AHEAD + codes));
        if (got <= 0) {
            return got == 0 ? DONE : BROKEN;
        }
        (void)clock_gettime(CLOCK_MONOTONIC, &begin);
        ridelab_counted = 0;
        input.stage = get(&frame[4]);
        for (int32_t i = 0; i < codes; i++) {
            input.codes[i] = get(&frame[4 * (WORDS_AHEAD + i)]);
        }
        flags = ridelab_step(&controller, &input, &output);
        memcpy(&slack, &output.slack, sizeof slack);
        memcpy(answer, frame, 4);
        put(&answer[4], (uint32_t)output.commands[0]);
        put(&answer[8], (uint32_t)output.commands[1]);
        put(&answer[12], (uint32_t)flags);
        put(&answer[16], (uint32_t)output.iterations);
        put(&answer[20], slack);
        put(&answer[24], ridelab_counted);
        put(&answer[28], nanoseconds_since(&begin));
        if (!send_all(link, answer, sizeof answer)) {
            return BROKEN;
        }
    }
}

int main(int count, char **arguments)
{
    unsigned char hello[8 + TOKEN + 4] = {'R', 'I', 'D', 'E', 'L', 'A', 'B', '1'};
    const ridelab_tables *tables;
    uint32_t fingerprint;
    int link;
    int result;
    const int port = count == 2 ? atoi(arguments[1]) : 0;
    if (port <= 0 || port > 65535 || fread(&hello[8], 1, TOKEN, stdin) != TOKEN) {
        (void)fputs("usage: ridelab_ecu PORT, a token of 32 bytes on standard input\n", stderr);
        return USAGE;
    }
    tables = ridelab_prepare(&fingerprint);
    if (tables == NULL) {
        (void)fputs("the tables could not be read\n", stderr);
        return NO_TABLES;
    }
    link = connect_to(port);
    put(&hello[8 + TOKEN], fingerprint);
    if (link < 0 || !send_all(link, hello, sizeof hello)) {
        (void)fputs("no plant listens there\n", stderr);
        return NO_PLANT;
    }
    result = serve(link, tables);
    (void)close(link);
    return result;
}
