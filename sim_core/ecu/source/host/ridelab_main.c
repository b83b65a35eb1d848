/* The controller as a process: answers the plant's frames from standard input on standard output until it hangs up.

   All numbers are little-endian, 32 bits each.
   hello: "RIDELAB2", the tables' fingerprint.
   frame: step, stage, codes. answer: step, two commands, flags, iterations, slack as a float, operations. */
#include <stdio.h>
#include <string.h>

#include "ridelab_calibration.h"
#include "ridelab_controller.h"
#include "ridelab_count.h"

#define WORDS_AHEAD 2
#define ANSWER 7

enum { DONE = 0, BROKEN = 5 };

uint32_t ridelab_counted;

static ridelab_controller controller;
static ridelab_input input = {.codes = ridelab_codes};

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

static int send_all(const unsigned char *place, size_t length)
{
    return fwrite(place, 1, length, stdout) == length && fflush(stdout) == 0;
}

static int serve(void)
{
    static unsigned char frame[4 * (WORDS_AHEAD + RIDELAB_CODE_COUNT)];
    unsigned char answer[4 * ANSWER];
    const size_t length = sizeof frame;
    size_t got;
    ridelab_init(&controller, &ridelab_calibration, ridelab_limits, ridelab_work);
    while ((got = fread(frame, 1, length, stdin)) == length) {
        ridelab_output output = {{0, 0}, 0, 0.0f};
        uint32_t slack;
        int32_t flags;
        ridelab_counted = 0;
        input.stage = get(&frame[4]);
        for (int32_t i = 0; i < RIDELAB_CODE_COUNT; i++) {
            ridelab_codes[i] = get(&frame[4 * (WORDS_AHEAD + i)]);
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
        if (!send_all(answer, sizeof answer)) {
            return BROKEN;
        }
    }
    return got == 0 ? DONE : BROKEN;
}

int main(void)
{
    unsigned char hello[12] = {'R', 'I', 'D', 'E', 'L', 'A', 'B', '2'};
    put(&hello[8], RIDELAB_FINGERPRINT);
    return send_all(hello, sizeof hello) ? serve() : BROKEN;
}
