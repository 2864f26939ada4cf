// SPDX-License-Identifier: Apache-2.0
//
// An active side that was built from another telehug.idl (another_version.idl): sends its touches and heartbeats, which
// are none of ours, every 20 ms until it is ended, which it is with the program that started it.
#include "another_version.h"

#include <dds/dds.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>

static dds_return_t must(dds_return_t result, const char* what) {
  if (result >= 0) return result;
  fprintf(stderr, "another_version: Cyclone DDS could not %s: %s\n", what, dds_strretcode(result));
  exit(1);
}

int main(int count, char** words) {
  if (count != 4) {
    fprintf(stderr, "another_version DOMAIN PARTITION SIDE: the side that its heartbeats name, a number\n");
    return 2;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const dds_entity_t participant =
      must(dds_create_participant((dds_domainid_t)strtoul(words[1], NULL, 10), NULL, NULL), "join the domain");
  dds_qos_t* qos = dds_create_qos();
  dds_qset_partition1(qos, words[2]);
  const dds_entity_t publisher = must(dds_create_publisher(participant, qos, NULL), "make a publisher");
  dds_reset_qos(qos);
  dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
  const dds_entity_t touch_topic =
      must(dds_create_topic(participant, &telehug_v1_TouchEvent_desc, "telehug/v1/active/touch", NULL, NULL), "touch");
  const dds_entity_t heartbeat_topic =
      must(dds_create_topic(participant, &telehug_v1_Heartbeat_desc, "telehug/v1/active/heartbeat", NULL, NULL),
           "heartbeat");
  const dds_entity_t touch_writer = must(dds_create_writer(publisher, touch_topic, qos, NULL), "touch");
  const dds_entity_t heartbeat_writer = must(dds_create_writer(publisher, heartbeat_topic, qos, NULL), "heartbeat");
  dds_delete_qos(qos);

  telehug_v1_TouchEvent touch = {.sequence_number = 0};
  telehug_v1_Heartbeat heartbeat = {.side = (uint32_t)strtoul(words[3], NULL, 10), .sent_time_ns = 1};
  memset(touch.session, 0x11, sizeof touch.session);
  memset(heartbeat.session, 0x11, sizeof heartbeat.session);
  for (;;) {
    ++touch.sequence_number;
    ++heartbeat.sequence_number;
    must(dds_write(touch_writer, &touch), "write a touch");
    must(dds_write(heartbeat_writer, &heartbeat), "write a heartbeat");
    dds_sleepfor(DDS_MSECS(20));
  }
}
