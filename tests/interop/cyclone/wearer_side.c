// SPDX-License-Identifier: Apache-2.0
//
// A wearer's side as somebody else would write it: C, on Cyclone DDS, with nothing of telehug but telehug.idl and what
// idl/README.md says about topics and QoS. Prints whatever the active side says, each message as a line of JSON, and
// answers it: a heartbeat with a heartbeat, each contact of a touch with a Felt, status and stop with the same words.
// Ends with the program that started it.
#include <dds/dds.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>

#include "telehug.h"

enum { max_taken = 64, session_bytes = 16, max_actuators = 16 };

typedef enum { BEST_EFFORT_NEWEST, RELIABLE_STREAM, RELIABLE_STATE } delivery;

static dds_entity_t felt_writer, heartbeat_writer, status_writer, stop_writer;
static telehug_v1_SessionBytes own_session;
static uint64_t heartbeats = 0;

static dds_return_t must(dds_return_t result, const char* what) {
  if (result >= 0) return result;
  fprintf(stderr, "wearer_side: Cyclone DDS could not %s: %s\n", what, dds_strretcode(result));
  exit(1);
}

// What is printed.

static const char* const phases[] = {
    [telehug_v1_PHASE_DOWN] = "down", [telehug_v1_PHASE_MOVE] = "move", [telehug_v1_PHASE_UP] = "up"};
static const char* const gestures[] = {
    [telehug_v1_GESTURE_NONE] = "none",     [telehug_v1_GESTURE_TAP] = "tap", [telehug_v1_GESTURE_HOLD] = "hold",
    [telehug_v1_GESTURE_STROKE] = "stroke", [telehug_v1_GESTURE_PAT] = "pat", [telehug_v1_GESTURE_HUG] = "hug"};
static const char* const sides[] = {[telehug_v1_SIDE_ACTIVE] = "active", [telehug_v1_SIDE_PASSIVE] = "passive"};

static void print_session(const char* name, const telehug_v1_SessionBytes session) {
  printf("\"%s\":\"", name);
  for (int i = 0; i < session_bytes; ++i)
    printf("%02x", session[i]);
  printf("\"");
}

static void print_text(const char* name, const char* text) {
  printf("\"%s\":\"", name);
  for (; *text != '\0'; ++text) {
    if (*text == '"' || *text == '\\') putchar('\\');
    putchar(*text);
  }
  printf("\"");
}

static void print_contact(const telehug_v1_Contact* contact) {
  printf("{\"id\":%" PRIu32 ",\"phase\":\"%s\",\"box\":%" PRIu16 ",\"columns\":%" PRIu16 ",\"rows\":%" PRIu16,
         contact->id, phases[contact->phase], contact->box, contact->grid.columns, contact->grid.rows);
  printf(",\"body_x_fh\":%.17g,\"body_y_fh\":%.17g,\"screen_x_mm\":%.17g,\"screen_y_mm\":%.17g", contact->body_x_fh,
         contact->body_y_fh, contact->screen_x_mm, contact->screen_y_mm);
  printf(",\"speed_mm_s\":%.17g,\"strength\":%.17g,\"gesture\":\"%s\"}", contact->speed_mm_s, contact->strength,
         gestures[contact->gesture]);
}

static void print_touch(const telehug_v1_TouchEvent* touch) {
  printf("{\"topic\":\"touch\",");
  print_session("session", touch->session);
  printf(",\"sequence\":%" PRIu64 ",\"frame_time_ns\":%" PRId64 ",\"sent_time_ns\":%" PRId64
         ",\"body_map_version\":%" PRIu32 ",\"contacts\":[",
         touch->sequence_number, touch->frame_time_ns, touch->sent_time_ns, touch->body_map_version);
  for (uint32_t i = 0; i < touch->contacts._length; ++i) {
    printf(i > 0 ? "," : "");
    print_contact(&touch->contacts._buffer[i]);
  }
  printf("],\"transitions\":[");
  for (uint32_t i = 0; i < touch->transitions._length; ++i) {
    const telehug_v1_Transition* transition = &touch->transitions._buffer[i];
    printf("%s{\"event_sequence\":%" PRIu64 ",\"frame_time_ns\":%" PRId64 ",\"contact\":", i > 0 ? "," : "",
           transition->event_sequence, transition->frame_time_ns);
    print_contact(&transition->contact);
    printf("}");
  }
  printf("]}\n");
}

static void print_heartbeat(const telehug_v1_Heartbeat* heartbeat) {
  printf("{\"topic\":\"heartbeat\",");
  print_session("session", heartbeat->session);
  printf(",\"side\":\"%s\",\"sequence\":%" PRIu64 ",\"sent_time_ns\":%" PRId64 ",", sides[heartbeat->side],
         heartbeat->sequence_number, heartbeat->sent_time_ns);
  print_session("echo_session", heartbeat->echo_session);
  printf(",\"echo_sent_time_ns\":%" PRId64 ",\"echo_held_ns\":%" PRId64 "}\n", heartbeat->echo_sent_time_ns,
         heartbeat->echo_held_ns);
}

static void print_status(const telehug_v1_SideStatus* status) {
  printf("{\"topic\":\"status\",");
  print_session("session", status->session);
  printf(",\"side\":\"%s\",\"ready\":%s,\"stopped\":%s,", sides[status->side], status->ready ? "true" : "false",
         status->stopped ? "true" : "false");
  print_text("version", status->version);
  printf(",");
  print_text("reason", status->reason);
  printf("}\n");
}

static void print_stop(const telehug_v1_StopAll* stop) {
  printf("{\"topic\":\"stop\",");
  print_session("session", stop->session);
  printf(",\"side\":\"%s\",\"sequence\":%" PRIu64 ",\"stop\":%s,", sides[stop->side], stop->sequence_number,
         stop->stop ? "true" : "false");
  print_text("reason", stop->reason);
  printf("}\n");
}

// What is answered. The test knows these rules, too.

static void answer_touch(const void* sample) {
  const telehug_v1_TouchEvent* touch = sample;
  print_touch(touch);
  uint8_t actuators[max_actuators];
  for (int i = 0; i < max_actuators; ++i)
    actuators[i] = (uint8_t)(255 - i);
  for (uint32_t i = 0; i < touch->contacts._length; ++i) {
    const telehug_v1_Contact* contact = &touch->contacts._buffer[i];
    telehug_v1_Felt felt = {.touch_sequence = touch->sequence_number,
                            .contact_id = contact->id,
                            .phase = contact->phase,
                            .box = contact->box,
                            .outcome = (telehug_v1_FeltOutcome)(i % (telehug_v1_FELT_ANOTHER_SENDER + 1)),
                            .actuators = {._maximum = max_actuators,
                                          ._length = 2 * i < max_actuators ? 2 * i : max_actuators,
                                          ._buffer = actuators},
                            .received_time_ns = touch->sent_time_ns,
                            .driven_time_ns = touch->frame_time_ns};
    memcpy(felt.session, own_session, session_bytes);
    memcpy(felt.touch_session, touch->session, session_bytes);
    must(dds_write(felt_writer, &felt), "write what was felt");
  }
}

static void answer_heartbeat(const void* sample) {
  const telehug_v1_Heartbeat* heard = sample;
  print_heartbeat(heard);
  telehug_v1_Heartbeat own = {.side = telehug_v1_SIDE_PASSIVE,
                              .sequence_number = ++heartbeats,
                              .sent_time_ns = heard->sent_time_ns,
                              .echo_sent_time_ns = heard->sent_time_ns,
                              .echo_held_ns = 1};
  memcpy(own.session, own_session, session_bytes);
  memcpy(own.echo_session, heard->session, session_bytes);
  must(dds_write(heartbeat_writer, &own), "write a heartbeat");
}

static void answer_status(const void* sample) {
  telehug_v1_SideStatus own = *(const telehug_v1_SideStatus*)sample;
  print_status(&own);
  own.side = telehug_v1_SIDE_PASSIVE;
  memcpy(own.session, own_session, session_bytes);
  must(dds_write(status_writer, &own), "write a status");
}

static void answer_stop(const void* sample) {
  telehug_v1_StopAll own = *(const telehug_v1_StopAll*)sample;
  print_stop(&own);
  own.side = telehug_v1_SIDE_PASSIVE;
  memcpy(own.session, own_session, session_bytes);
  must(dds_write(stop_writer, &own), "write a stop");
}

// Topics and QoS as idl/README.md has them.

static dds_qos_t* qos_of(delivery how) {
  dds_qos_t* qos = dds_create_qos();
  const bool reliable = how != BEST_EFFORT_NEWEST;
  dds_qset_reliability(qos, reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_SECS(1));
  dds_qset_durability(qos, how == RELIABLE_STATE ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, how == RELIABLE_STREAM ? 64 : 1);
  return qos;
}

static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* name) {
  return must(dds_create_topic(participant, type, name, NULL, NULL), name);
}

static dds_entity_t writer(dds_entity_t publisher, const dds_topic_descriptor_t* type, const char* name, delivery how) {
  dds_qos_t* qos = qos_of(how);
  const dds_entity_t made =
      must(dds_create_writer(publisher, topic(dds_get_participant(publisher), type, name), qos, NULL), name);
  dds_delete_qos(qos);
  return made;
}

static dds_entity_t reader(dds_entity_t subscriber, const dds_topic_descriptor_t* type, const char* name,
                           delivery how) {
  dds_qos_t* qos = qos_of(how);
  const dds_entity_t made =
      must(dds_create_reader(subscriber, topic(dds_get_participant(subscriber), type, name), qos, NULL), name);
  dds_delete_qos(qos);
  return made;
}

typedef struct {
  dds_entity_t reader;
  void (*answer)(const void* sample);
} subscription;

static void take_all(const subscription* from) {
  void* samples[max_taken] = {NULL};
  dds_sample_info_t infos[max_taken];
  const dds_return_t taken = must(dds_take(from->reader, samples, infos, max_taken, max_taken), "take samples");
  for (dds_return_t i = 0; i < taken; ++i)
    if (infos[i].valid_data) from->answer(samples[i]);
  if (taken > 0) must(dds_return_loan(from->reader, samples, taken), "give samples back");
}

int main(int count, char** words) {
  if (count != 4 || strlen(words[3]) != (size_t)2 * session_bytes) {
    fprintf(stderr, "wearer_side DOMAIN PARTITION SESSION: the session is 32 hexadecimal digits\n");
    return 2;
  }
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  setvbuf(stdout, NULL, _IOLBF, 1 << 16);
  for (int i = 0; i < session_bytes; ++i) {
    const char byte[] = {words[3][2 * i], words[3][2 * i + 1], '\0'};
    own_session[i] = (uint8_t)strtoul(byte, NULL, 16);
  }

  const dds_entity_t participant =
      must(dds_create_participant((dds_domainid_t)strtoul(words[1], NULL, 10), NULL, NULL), "join the domain");
  dds_qos_t* in_partition = dds_create_qos();
  dds_qset_partition1(in_partition, words[2]);
  const dds_entity_t publisher = must(dds_create_publisher(participant, in_partition, NULL), "make a publisher");
  const dds_entity_t subscriber = must(dds_create_subscriber(participant, in_partition, NULL), "make a subscriber");
  dds_delete_qos(in_partition);

  felt_writer = writer(publisher, &telehug_v1_Felt_desc, "telehug/v1/passive/felt", RELIABLE_STREAM);
  heartbeat_writer = writer(publisher, &telehug_v1_Heartbeat_desc, "telehug/v1/passive/heartbeat", BEST_EFFORT_NEWEST);
  status_writer = writer(publisher, &telehug_v1_SideStatus_desc, "telehug/v1/passive/status", RELIABLE_STATE);
  stop_writer = writer(publisher, &telehug_v1_StopAll_desc, "telehug/v1/passive/stop", RELIABLE_STATE);

  const subscription subscriptions[] = {
      {reader(subscriber, &telehug_v1_TouchEvent_desc, "telehug/v1/active/touch", BEST_EFFORT_NEWEST), answer_touch},
      {reader(subscriber, &telehug_v1_Heartbeat_desc, "telehug/v1/active/heartbeat", BEST_EFFORT_NEWEST),
       answer_heartbeat},
      {reader(subscriber, &telehug_v1_SideStatus_desc, "telehug/v1/active/status", RELIABLE_STATE), answer_status},
      {reader(subscriber, &telehug_v1_StopAll_desc, "telehug/v1/active/stop", RELIABLE_STATE), answer_stop},
  };
  const dds_entity_t waitset = must(dds_create_waitset(participant), "make a waitset");
  for (size_t i = 0; i < sizeof subscriptions / sizeof *subscriptions; ++i) {
    const dds_entity_t any = must(dds_create_readcondition(subscriptions[i].reader, DDS_ANY_STATE), "wait for samples");
    must(dds_waitset_attach(waitset, any, (dds_attach_t)&subscriptions[i]), "wait for samples");
  }
  for (;;) {
    dds_attach_t ready[sizeof subscriptions / sizeof *subscriptions];
    const dds_return_t how_many =
        must(dds_waitset_wait(waitset, ready, sizeof ready / sizeof *ready, DDS_INFINITY), "wait for samples");
    for (dds_return_t i = 0; i < how_many; ++i)
      take_all((const subscription*)ready[i]);
  }
}
