/* What a control unit's program keeps besides its drivers: call ridelab_firmware_start once, then ridelab_firmware_step
   every control step, between reading the converters into ridelab_firmware_input.stage and ridelab_codes, and writing
   ridelab_firmware_output. */
#include "ridelab_calibration.h"
#include "ridelab_controller.h"

ridelab_input ridelab_firmware_input;
ridelab_output ridelab_firmware_output;

static ridelab_controller controller;

void ridelab_firmware_start(void);
int32_t ridelab_firmware_step(void);

void ridelab_firmware_start(void)
{
    ridelab_firmware_input.codes = ridelab_codes;
    ridelab_init(&controller, &ridelab_calibration, ridelab_limits, ridelab_work);
}

int32_t ridelab_firmware_step(void)
{
    return ridelab_step(&controller, &ridelab_firmware_input, &ridelab_firmware_output);
}
