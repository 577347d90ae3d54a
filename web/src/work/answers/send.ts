// The one sender of this tab. It works in every view, so answers are sent even after the work view is left.
import { api, unwrap } from '../../api/client';
import { shell } from '../../ui/shell.svelte';
import { AnswerSender, type SendAnswer } from './sender';

const postAnswer: SendAnswer = ({ assignment, token, answer, key }, next) => {
  const params = { path: { assignment }, header: { 'Idempotency-Key': key } };
  return unwrap(
    api.POST('/api/v1/assignments/{assignment}/answer', { params, body: { token, answer, next } }),
  );
};

export const sender = new AnswerSender(postAnswer, sessionStorage, (outbox, isKept) => {
  shell.unsaved = outbox.length;
  shell.unsavedAreKept = isKept;
});
